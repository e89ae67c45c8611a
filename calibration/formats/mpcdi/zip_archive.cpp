#include "calibration/formats/mpcdi/zip_archive.h"

#include <fmt/format.h>
#include <zip.h>

#include <algorithm>
#include <cstdint>

#include "kernels/core/error.h"

namespace ergodome {

namespace {

constexpr zip_int64_t max_entries = 4096;
//! Maximum compression ratio of members. Smooth warps are compressed about twentyfold, empty masks
//! a few hundredfold; small members may exceed the ratio.
constexpr std::size_t largest_ratio = 500;
constexpr std::size_t small_member = std::size_t{1} << 20U;

//! Returns a libzip error code as a text.
std::string text_of(int code) {
  zip_error_t error;
  zip_error_init_with_code(&error, code);
  std::string text = zip_error_strerror(&error);
  zip_error_fini(&error);
  return text;
}

struct CloseMember {
  void operator()(zip_file_t* member) const { zip_fclose(member); }
};

void check_member(const zip_stat_t& stat, const std::string& location, std::size_t max_bytes) {
  constexpr zip_uint64_t wanted =
      ZIP_STAT_SIZE | ZIP_STAT_COMP_SIZE | ZIP_STAT_COMP_METHOD | ZIP_STAT_ENCRYPTION_METHOD;
  if ((stat.valid & wanted) != wanted) {
    throw Error(location, "has no size in the archive", "pack the archive again");
  }
  if (stat.encryption_method != ZIP_EM_NONE) {
    throw Error(location, "is encrypted", "pack the archive without a password");
  }
  if (stat.comp_method != ZIP_CM_STORE && stat.comp_method != ZIP_CM_DEFLATE) {
    throw Error(location, "is compressed by an unsupported method", "pack the archive with deflate");
  }
  if (stat.size > max_bytes) {
    throw Error(location, fmt::format("would unpack to {} bytes", stat.size),
                fmt::format("use at most {} bytes", max_bytes));
  }
  if (stat.size > small_member && stat.size / largest_ratio > stat.comp_size) {
    throw Error(location, fmt::format("would unpack from {} to {} bytes", stat.comp_size, stat.size),
                fmt::format("this looks like a zip bomb; compress it by less than {} times", largest_ratio));
  }
}

}  // namespace

struct ZipArchive::Handle {
  zip_t* archive = nullptr;

  explicit Handle(zip_t* opened) : archive(opened) {}
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle() { zip_discard(archive); }
};

ZipArchive::ZipArchive(std::span<const std::byte> bytes, std::string name, std::size_t max_unpacked)
    : name_(std::move(name)), archive_bytes_(bytes.size()), unpacked_left_(max_unpacked) {
  zip_error_t error;
  zip_error_init(&error);
  zip_source_t* const source = zip_source_buffer_create(bytes.data(), bytes.size(), 0, &error);
  zip_t* const archive = source != nullptr ? zip_open_from_source(source, ZIP_RDONLY, &error) : nullptr;
  if (archive == nullptr) {
    zip_source_free(source);
    const std::string text = zip_error_strerror(&error);
    zip_error_fini(&error);
    throw Error(name_, "cannot be opened as a zip archive: " + text,
                "the file is truncated or damaged; export it again");
  }
  handle_ = std::make_unique<Handle>(archive);
  const zip_int64_t entries = zip_get_num_entries(archive, 0);
  if (entries > max_entries) {
    throw Error(name_, fmt::format("contains {} entries", entries), fmt::format("use at most {} entries", max_entries));
  }
}

ZipArchive::~ZipArchive() = default;

namespace {

//! Returns the index of a member, or -1. Some Windows programs write backslashes between folders.
zip_int64_t located(zip_t* archive, std::string member) {
  const zip_int64_t index = zip_name_locate(archive, member.c_str(), ZIP_FL_NOCASE);
  if (index >= 0 || member.find('/') == std::string::npos) {
    return index;
  }
  std::ranges::replace(member, '/', '\\');
  return zip_name_locate(archive, member.c_str(), ZIP_FL_NOCASE);
}

}  // namespace

bool ZipArchive::has(const std::string& member) const { return located(handle_->archive, member) >= 0; }

std::string ZipArchive::read(const std::string& member, std::size_t max_bytes) {
  const std::string location = fmt::format("{}: {}", name_, member.substr(0, 200));
  const zip_int64_t index = located(handle_->archive, member);
  zip_stat_t stat;
  if (index < 0 || zip_stat_index(handle_->archive, static_cast<zip_uint64_t>(index), 0, &stat) != 0) {
    throw Error(location, "is not in the archive", "export the archive again with this file");
  }
  check_member(stat, location, max_bytes);
  if (stat.comp_size > archive_bytes_) {
    throw Error(location, "is larger than its archive", "the file is truncated or damaged; export it again");
  }
  const auto size = static_cast<std::size_t>(stat.size);
  if (size > unpacked_left_) {
    throw Error(location, "would exceed the limit of the total unpacked size", "split the archive");
  }
  unpacked_left_ -= size;
  const std::unique_ptr<zip_file_t, CloseMember> file(
      zip_fopen_index(handle_->archive, static_cast<zip_uint64_t>(index), 0));
  if (!file) {
    throw Error(location, std::string("cannot be unpacked: ") + zip_strerror(handle_->archive),
                "pack the archive again");
  }
  // Reads one byte more than announced, so that libzip reaches the end and verifies the checksum.
  std::string bytes(size + 1, '\0');
  std::size_t filled = 0;
  zip_int64_t got = 0;
  while (filled < bytes.size() && (got = zip_fread(file.get(), bytes.data() + filled, bytes.size() - filled)) > 0) {
    filled += static_cast<std::size_t>(got);
  }
  if (got < 0 || filled != size) {
    const std::string why = got < 0 ? text_of(zip_error_code_zip(zip_file_get_error(file.get()))) : "its size is wrong";
    throw Error(location, "cannot be unpacked: " + why, "the file is truncated or damaged; export it again");
  }
  bytes.resize(size);
  return bytes;
}

namespace {

//! Adds the members to the archive; their bytes must stay valid until it is closed. Returns false
//! if libzip fails.
bool fill(zip_t* archive, const std::vector<std::pair<std::string, std::string>>& members) {
  for (const auto& [name, bytes] : members) {
    zip_source_t* const source = zip_source_buffer(archive, bytes.data(), bytes.size(), 0);
    const zip_int64_t index = source != nullptr ? zip_file_add(archive, name.c_str(), source, ZIP_FL_ENC_UTF_8) : -1;
    if (index < 0) {
      zip_source_free(source);
      return false;
    }
    // 1980-01-01, the earliest date of the format, so that the bytes depend only on the members.
    constexpr zip_uint16_t earliest_date = (1U << 5U) | 1U;
    if (zip_file_set_dostime(archive, static_cast<zip_uint64_t>(index), 0, earliest_date, 0) != 0) {
      return false;
    }
  }
  return true;
}

std::string bytes_of(zip_source_t* source, bool& good) {
  zip_stat_t stat;
  std::string bytes;
  good = zip_source_stat(source, &stat) == 0 && zip_source_open(source) == 0;
  if (good) {
    bytes.resize(static_cast<std::size_t>(stat.size));
    good = zip_source_read(source, bytes.data(), bytes.size()) == static_cast<zip_int64_t>(bytes.size());
    zip_source_close(source);
  }
  return bytes;
}

}  // namespace

std::string zip_of(const std::vector<std::pair<std::string, std::string>>& members, const std::string& name) {
  zip_error_t error;
  zip_error_init(&error);
  zip_source_t* const source = zip_source_buffer_create(nullptr, 0, 0, &error);
  zip_t* const archive = source != nullptr ? zip_open_from_source(source, ZIP_TRUNCATE, &error) : nullptr;
  if (archive == nullptr) {
    zip_source_free(source);
    throw Error(name, std::string("cannot be packed: ") + zip_error_strerror(&error), "free some memory");
  }
  zip_source_keep(source);
  bool good = fill(archive, members) && zip_close(archive) == 0;
  std::string bytes;
  if (good) {
    bytes = bytes_of(source, good);
  } else {
    zip_discard(archive);
  }
  zip_source_free(source);
  if (!good) {
    throw Error(name, "cannot be packed", "free some memory");
  }
  return bytes;
}

}  // namespace ergodome
