#include "content/images/formats/image_bytes.h"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <memory>

namespace ergodome {

NextBytes ImageBytes::from_start() const {
  if (bytes_) {
    return [left = *bytes_](char* to, std::size_t count) mutable {
      const bool enough = count <= left.size();
      if (enough) {
        std::memcpy(to, left.data(), count);
        left = left.subspan(count);
      }
      return enough;
    };
  }
  return [file = std::make_shared<std::ifstream>(name_, std::ios::binary)](char* to, std::size_t count) {
    return static_cast<bool>(file->read(to, static_cast<std::streamsize>(count)));
  };
}

std::string ImageBytes::head(std::size_t maximum) const {
  if (bytes_) {
    return {reinterpret_cast<const char*>(bytes_->data()), std::min(bytes_->size(), maximum)};
  }
  std::string head(static_cast<std::size_t>(std::min<std::uintmax_t>(size(), maximum)), '\0');
  std::ifstream file(name_, std::ios::binary);
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(file.gcount()));
  return head;
}

std::string ImageBytes::all() const {
  if (bytes_) {
    return {reinterpret_cast<const char*>(bytes_->data()), bytes_->size()};
  }
  std::error_code problem;
  if (!std::filesystem::is_regular_file(name_, problem)) {
    return "";  // A folder can be opened but not read.
  }
  return head(std::numeric_limits<std::size_t>::max());
}

std::uintmax_t ImageBytes::size() const {
  std::error_code problem;
  const std::uintmax_t size = bytes_ ? bytes_->size() : std::filesystem::file_size(name_, problem);
  return problem ? 0 : size;
}

}  // namespace ergodome
