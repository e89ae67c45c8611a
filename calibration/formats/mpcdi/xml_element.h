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

//! An untrusted XML file: UTF-8, of limited size and depth, without a document type. pugixml
//! supports only the five predefined entities and reads no other file; document types are refused
//! nevertheless, so that no file depends on its entities.
class XmlFile {
 public:
  //! Throws Error with the line if the text is not well-formed XML, is nested too deeply, or
  //! declares a document type.
  XmlFile(std::string_view text, std::string name);

  [[nodiscard]] pugi::xml_node root() const;
  //! Returns "FILE:LINE" of an element.
  [[nodiscard]] std::string location(const pugi::xml_node& node) const;

 private:
  [[nodiscard]] std::string location(std::ptrdiff_t offset) const;

  std::string name_;
  std::string text_;
  pugi::xml_document document_;
};

//! An element of an XmlFile. Names are case-insensitive, as MPCDI requires (VESA MPCDI 2.0, 3.5.2);
//! values are not. The XmlFile must outlive the element.
class XmlElement {
 public:
  XmlElement(const XmlFile& file, const pugi::xml_node& node) : file_(&file), node_(node) {}

  [[nodiscard]] std::string name() const { return node_.name(); }
  //! Returns "FILE:LINE".
  [[nodiscard]] std::string location() const { return file_->location(node_); }
  [[nodiscard]] std::optional<XmlElement> child(std::string_view name) const;
  //! Returns a required child. Throws Error if it is missing.
  [[nodiscard]] XmlElement needed_child(std::string_view name) const;
  [[nodiscard]] std::vector<XmlElement> children(std::string_view name) const;

  //! Returns the text in the element, without surrounding blanks.
  [[nodiscard]] std::string text() const;
  //! Returns a child's text; `otherwise` if the child is missing or empty.
  [[nodiscard]] std::string text_of(std::string_view name, const std::string& otherwise) const;
  //! Returns a child's number, finite and at most 1e9 in magnitude. Without `otherwise`, throws
  //! Error if it is missing.
  [[nodiscard]] double number_of(std::string_view name, std::optional<double> otherwise = {}) const;

  [[nodiscard]] std::optional<std::string> attribute(std::string_view name) const;
  [[nodiscard]] std::string needed_attribute(std::string_view name) const;
  [[nodiscard]] double number_attribute(std::string_view name, std::optional<double> otherwise = {}) const;
  [[nodiscard]] int whole_attribute(std::string_view name, int minimum, int maximum,
                                    std::optional<int> otherwise = {}) const;

  //! Returns an error "FILE:LINE: <NAME> PROBLEM; REMEDY".
  [[nodiscard]] Error error(const std::string& problem, const std::string& remedy) const;

 private:
  [[nodiscard]] double finite(const std::string& word, std::string_view of) const;

  const XmlFile* file_;
  pugi::xml_node node_;
};

}  // namespace ergodome
