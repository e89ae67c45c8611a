#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "content/images/formats/png_chunks.h"

namespace ergodome {

//! The bytes of an image, from a file or from memory.
class ImageBytes {
 public:
  ImageBytes(std::string name, std::optional<std::span<const std::byte>> bytes)
      : name_(std::move(name)), bytes_(bytes) {}

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] const std::optional<std::span<const std::byte>>& memory() const { return bytes_; }

  //! Returns a function that reads the bytes from the first on. It must not outlive the bytes.
  [[nodiscard]] NextBytes from_start() const;

  //! Returns the first `maximum` bytes, or all if there are fewer.
  [[nodiscard]] std::string head(std::size_t maximum) const;

  [[nodiscard]] std::string all() const;

  //! Returns the size [bytes]; 0 if the file cannot be read.
  [[nodiscard]] std::uintmax_t size() const;

 private:
  std::string name_;
  std::optional<std::span<const std::byte>> bytes_;
};

}  // namespace ergodome
