#include "calibration/formats/mpcdi/xml_element.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "calibration/warps/text_lines.h"

namespace ergodome {

namespace {

constexpr int max_depth = 32;
constexpr double largest_number = 1e9;

char small_letter(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

bool same_name(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](char x, char y) { return small_letter(x) == small_letter(y); });
}

std::string shown_text(std::string_view text) { return std::string(text.substr(0, 60)); }

std::string trimmed(std::string_view text) {
  constexpr std::string_view blanks = " \t\r\n";
  const std::size_t begin = text.find_first_not_of(blanks);
  if (begin == std::string_view::npos) {
    return {};
  }
  return std::string(text.substr(begin, text.find_last_not_of(blanks) - begin + 1));
}

//! Finds nodes for which a file is refused: document types, and elements that are nested too
//! deeply.
struct Inspector : pugi::xml_tree_walker {
  pugi::xml_node too_deep;
  pugi::xml_node document_type;

  bool for_each(pugi::xml_node& node) override {
    if (node.type() == pugi::node_doctype) {
      document_type = node;
    } else if (depth() > max_depth) {
      too_deep = node;
    }
    return document_type.empty() && too_deep.empty();
  }
};

}  // namespace

XmlFile::XmlFile(std::string_view text, std::string name) : name_(std::move(name)), text_(text) {
  const pugi::xml_parse_result result =
      document_.load_buffer(text_.data(), text_.size(), pugi::parse_default | pugi::parse_doctype, pugi::encoding_utf8);
  if (!result) {
    throw Error(location(result.offset), fmt::format("is not well-formed XML: {}", result.description()),
                "correct the file");
  }
  Inspector inspector;
  document_.traverse(inspector);
  if (inspector.document_type) {
    throw Error(name_, "declares a document type", "remove <!DOCTYPE ...>; these files do not need it");
  }
  if (inspector.too_deep) {
    throw Error(location(inspector.too_deep), fmt::format("is nested deeper than {} elements", max_depth),
                "export it again");
  }
  if (!root()) {
    throw Error(name_, "contains no XML element", "export it again");
  }
}

pugi::xml_node XmlFile::root() const { return document_.document_element(); }

std::string XmlFile::location(std::ptrdiff_t offset) const {
  const auto end = std::clamp<std::ptrdiff_t>(offset, 0, static_cast<std::ptrdiff_t>(text_.size()));
  return fmt::format("{}:{}", name_, 1 + std::count(text_.begin(), text_.begin() + end, '\n'));
}

std::string XmlFile::location(const pugi::xml_node& node) const { return location(node.offset_debug()); }

std::optional<XmlElement> XmlElement::child(std::string_view name) const {
  for (const pugi::xml_node& node : node_.children()) {
    if (node.type() == pugi::node_element && same_name(node.name(), name)) {
      return XmlElement(*file_, node);
    }
  }
  return std::nullopt;
}

XmlElement XmlElement::needed_child(std::string_view name) const {
  const auto found = child(name);
  if (!found) {
    throw error(fmt::format("has no <{}>", name), fmt::format("add <{}>", name));
  }
  return *found;
}

std::vector<XmlElement> XmlElement::children(std::string_view name) const {
  std::vector<XmlElement> found;
  for (const pugi::xml_node& node : node_.children()) {
    if (node.type() == pugi::node_element && same_name(node.name(), name)) {
      found.emplace_back(*file_, node);
    }
  }
  return found;
}

std::string XmlElement::text() const { return trimmed(node_.text().get()); }

std::string XmlElement::text_of(std::string_view name, const std::string& otherwise) const {
  const auto found = child(name);
  const std::string text = found ? found->text() : "";
  return text.empty() ? otherwise : text;
}

double XmlElement::finite(const std::string& word, std::string_view of) const {
  const auto number = ergodome::number_of(word);
  if (!number || !(std::abs(*number) <= largest_number)) {
    throw error(fmt::format("has {} = \"{}\"", of, shown_text(word)), "write a finite number");
  }
  return *number;
}

double XmlElement::number_of(std::string_view name, std::optional<double> otherwise) const {
  const std::string word = text_of(name, "");
  if (!word.empty()) {
    return finite(word, name);
  }
  if (!otherwise) {
    throw error(fmt::format("has no <{}>", name), fmt::format("add <{}> with a number", name));
  }
  return *otherwise;
}

std::optional<std::string> XmlElement::attribute(std::string_view name) const {
  for (const pugi::xml_attribute& each : node_.attributes()) {
    if (same_name(each.name(), name)) {
      return each.value();
    }
  }
  return std::nullopt;
}

std::string XmlElement::needed_attribute(std::string_view name) const {
  const auto found = attribute(name);
  if (!found || found->empty()) {
    throw error(fmt::format("has no attribute {}", name), fmt::format("add {}=\"...\"", name));
  }
  return *found;
}

double XmlElement::number_attribute(std::string_view name, std::optional<double> otherwise) const {
  const auto found = attribute(name);
  if (!found && otherwise) {
    return *otherwise;
  }
  return finite(trimmed(needed_attribute(name)), name);
}

int XmlElement::whole_attribute(std::string_view name, int minimum, int maximum, std::optional<int> otherwise) const {
  const auto found = attribute(name);
  if (!found && otherwise) {
    return *otherwise;
  }
  const std::string word = trimmed(needed_attribute(name));
  const auto number = whole_number_of(word);
  if (!number || *number < minimum || *number > maximum) {
    throw error(fmt::format("has {}=\"{}\"", name, shown_text(word)),
                fmt::format("write a whole number from {} to {}", minimum, maximum));
  }
  return static_cast<int>(*number);
}

Error XmlElement::error(const std::string& problem, const std::string& remedy) const {
  return {location(), fmt::format("<{}> {}", shown_text(node_.name()), problem), remedy};
}

}  // namespace ergodome
