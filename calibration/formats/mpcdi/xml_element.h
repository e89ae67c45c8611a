#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "kernels/core/error.h"

namespace ergodome {

//! An XML file of a stranger: UTF-8, of bounded size and depth, without a document type. pugixml knows no entities but the five
//! of XML, and reads no other file; what declares entities is refused all the same, so that nobody relies on them.
class XmlFile {
 public:
  //! Throws Error with the line where the text is no well-formed XML, too deep, or declares a document type.
  XmlFile(std::string_view text, std::string name);

  [[nodiscard]] pugi::xml_node root() const;
  //! "FILE:LINE" of an element.
  [[nodiscard]] std::string place(const pugi::xml_node& node) const;

 private:
  [[nodiscard]] std::string place(std::ptrdiff_t offset) const;

  std::string name_;
  std::string text_;
  pugi::xml_document document_;
};

//! One element of such a file. Names are compared without regard to capitals, as MPCDI asks (VESA MPCDI 2.0, 3.5.2); values keep
//! theirs. The file must outlive it.
class XmlElement {
 public:
  XmlElement(const XmlFile& file, const pugi::xml_node& node) : file_(&file), node_(node) {}

  [[nodiscard]] std::string name() const { return node_.name(); }
  //! "FILE:LINE".
  [[nodiscard]] std::string place() const { return file_->place(node_); }
  [[nodiscard]] std::optional<XmlElement> child(std::string_view name) const;
  //! A child that must be there.
  [[nodiscard]] XmlElement needed_child(std::string_view name) const;
  [[nodiscard]] std::vector<XmlElement> children(std::string_view name) const;

  //! The text in it, without the blanks around.
  [[nodiscard]] std::string text() const;
  //! A child's text; `otherwise` where there is no such child or nothing in it.
  [[nodiscard]] std::string text_of(std::string_view name, const std::string& otherwise) const;
  //! A finite number of size 1e9 at the most; without `otherwise` it must be there.
  [[nodiscard]] double number_of(std::string_view name, std::optional<double> otherwise = {}) const;

  [[nodiscard]] std::optional<std::string> attribute(std::string_view name) const;
  [[nodiscard]] std::string needed_attribute(std::string_view name) const;
  [[nodiscard]] double number_attribute(std::string_view name, std::optional<double> otherwise = {}) const;
  [[nodiscard]] int whole_attribute(std::string_view name, int least, int greatest,
                                    std::optional<int> otherwise = {}) const;

  //! "FILE:LINE: <NAME> PROBLEM; REMEDY".
  [[nodiscard]] Error error(const std::string& problem, const std::string& remedy) const;

 private:
  [[nodiscard]] double finite(const std::string& word, std::string_view of) const;

  const XmlFile* file_;
  pugi::xml_node node_;
};

}  // namespace ergodome
