#pragma once

#include <cstddef>
#include <cstdint>
#include <istream>
#include <memory>
#include <span>
#include <string>

namespace ergodome {

//! Reads bytes from a stream and decompresses them if they are gzip (RFC 1952, one or several
//! members), whatever the file's name.
class UnpackedStream {
 public:
  //! `location` is the name in errors. The stream must outlive this object.
  UnpackedStream(std::istream& stream, std::string location);
  ~UnpackedStream();
  UnpackedStream(const UnpackedStream&) = delete;
  UnpackedStream& operator=(const UnpackedStream&) = delete;

  //! Writes the next bytes to `out`, and returns how many: at least one, possibly fewer than fit; 0
  //! at the end. Throws Error if the stream cannot be read, or if the compressed data are damaged,
  //! truncated, or expand to an implausible size.
  std::size_t read(std::span<char> out);

 private:
  struct Inflater;

  //! Reads the next bytes of the stream, compressed or not, to `packed_`; returns false at its end.
  bool refill();
  std::size_t unpack(std::span<char> out);
  void require_plausible_size() const;

  std::istream& stream_;
  std::string location_;
  std::string packed_;                  //!< bytes read from the stream
  std::size_t next_ = 0;                //!< index in `packed_` of the first byte to unpack
  std::uint64_t packed_bytes_ = 0;      //!< total number of bytes read
  std::uint64_t unpacked_bytes_ = 0;    //!< total number of bytes written
  std::unique_ptr<Inflater> inflater_;  //!< null for uncompressed data
  bool in_member_ = false;
};

}  // namespace ergodome
