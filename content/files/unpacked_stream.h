#pragma once

#include <cstddef>
#include <cstdint>
#include <istream>
#include <memory>
#include <span>
#include <string>

namespace ergodome {

//! Reads bytes from a stream and unpacks them if they are gzip (RFC 1952, one or several members),
//! whatever the file's name.
class UnpackedStream {
 public:
  //! `place` goes into errors. The stream has to outlive this object.
  UnpackedStream(std::istream& stream, std::string place);
  ~UnpackedStream();
  UnpackedStream(const UnpackedStream&) = delete;
  UnpackedStream& operator=(const UnpackedStream&) = delete;

  //! Fills `out` as far as bytes are left and returns how many it wrote; 0 at the end. Throws Error
  //! if the stream cannot be read, if the packed data are damaged or cut off, and if they unpack to
  //! an implausible size.
  std::size_t read(std::span<char> out);

 private:
  struct Inflater;

  //! Reads packed bytes; returns false at the end of the stream.
  bool refill();
  std::size_t unpack(std::span<char> out);
  void require_plausible_size() const;

  std::istream& stream_;
  std::string place_;
  std::string packed_;                  //!< bytes of the stream that were read
  std::size_t next_ = 0;                //!< first of them that is not used
  std::uint64_t packed_bytes_ = 0;      //!< read in all
  std::uint64_t unpacked_bytes_ = 0;    //!< written in all
  std::unique_ptr<Inflater> inflater_;  //!< none for plain bytes
  bool in_member_ = false;
};

}  // namespace ergodome
