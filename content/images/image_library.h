#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

// Interfaces to OpenImageIO, and to CFITSIO, which comes with it. Loading these takes a quarter of
// a second because of the hundreds of libraries that they need, and most commands need no image.
// Their implementation is therefore a shared library that the first call of image_library() loads.

namespace ergodome {

//! Shape of an image as it is shown: rotated by the file's Orientation (TIFF, Exif), unless
//! Wishes::as_stored is set. For OpenEXR, it is the display window, which is black where the file
//! has no pixels.
struct ImageShape {
  int width = 0;
  int height = 0;
  int depth = 1;
  int channels = 0;
  int alpha_channel = -1;  //!< index of the alpha channel; -1 if there is none
  int sample_bytes = 1;
  bool encoded = false;         //!< the numbers are encoded as sRGB
  bool separate_alpha = false;  //!< the colors are not premultiplied by alpha
};

//! An opened image. Functions that return bool return false if the file is damaged; error() then
//! returns the reason.
class ImageInput {
 public:
  ImageInput() = default;
  virtual ~ImageInput() = default;
  ImageInput(const ImageInput&) = delete;
  ImageInput& operator=(const ImageInput&) = delete;

  [[nodiscard]] virtual const ImageShape& shape() const = 0;

  //! Selects another image of the file by its index.
  virtual bool go_to_part(int part) = 0;

  //! Reads the first `channels` channels of rows [begin, end), counted from the top. Rows of tiled
  //! images are cheap only in order: only the last tiles read are kept.
  virtual bool read_rows(int begin, int end, int channels, float* to) = 0;
  virtual bool read_all(int channels, float* to) = 0;
  virtual bool read_all(int channels, std::uint16_t* to) = 0;

  //! Reads all rows and discards them, to check the file.
  virtual bool read_through() = 0;

  //! Returns an attribute of the selected image by its OpenImageIO name, or the file format for
  //! "format"; empty if it does not exist.
  [[nodiscard]] virtual std::string text(const std::string& name) const = 0;

  //! Returns the last error message and clears it.
  virtual std::string error() = 0;
};

enum class ImageSample { whole_8, whole_16, half, real };

//! Size, sample type and metadata of an image to write.
struct ImagePlan {
  int width = 0;
  int height = 0;
  int channels = 3;
  ImageSample sample = ImageSample::whole_8;
  std::vector<std::pair<std::string, std::string>> texts;  //!< attributes by their OpenImageIO names
  std::vector<std::pair<std::string, int>> numbers;
  std::vector<float> chromaticities;  //!< xy of red, green, blue and white; empty for none
  std::vector<std::pair<std::string, std::array<int, 2>>> ratios{};
  std::vector<std::string> channel_names{};  //!< names of all channels; empty for R, G, B, A
};

//! A keyword of a FITS header. Names have up to 8 characters of A-Z, 0-9, - and _.
struct FitsCard {
  std::string name;
  std::variant<std::string, double, int> value;  //!< a text or a finite number
  std::string comment{};
};

//! An image extension of a FITS file: doubles, NaN for missing values.
struct FitsImage {
  std::vector<FitsCard> cards;
  int width = 0;
  int height = 0;
  std::span<const double> pixels;  //!< row by row from the top; in the file the lowest row comes first
};

//! A file being written. Functions that return bool return false if writing fails; error() then
//! returns the reason.
class ImageOutput {
 public:
  ImageOutput() = default;
  virtual ~ImageOutput() = default;
  ImageOutput(const ImageOutput&) = delete;
  ImageOutput& operator=(const ImageOutput&) = delete;

  //! Creates a file with one or several parts and begins its first part; open_next() begins the
  //! next.
  virtual bool open(const std::string& path, std::span<const ImagePlan> parts) = 0;
  virtual bool open_next(const std::string& path, const ImagePlan& part) = 0;

  //! Writes all pixels of the part of the file that open() or open_next() began last.
  virtual bool write(const float* pixels) = 0;
  virtual bool write(const std::uint8_t* pixels) = 0;
  virtual bool write(const std::uint16_t* pixels) = 0;

  virtual bool close() = 0;
  virtual std::string error() = 0;
};

//! A bitmap to draw on: floats, top row first.
struct ImageCanvas {
  float* pixels;
  int width;
  int height;
  int channels;
};

//! The point of a text's box that is put at the requested position.
enum class TextAnchor { baseline_start, top_centre, centre };

struct TextStyle {
  int font_px;
  std::span<const float> colour;  //!< color to draw with, one number per channel
  TextAnchor anchor = TextAnchor::baseline_start;
  int shadow_px = 0;
};

//! The pixels that a text covers if its baseline starts at (0, 0).
struct TextBox {
  int left, top, width, height;
};

class ImageLibrary {
 public:
  ImageLibrary() = default;
  virtual ~ImageLibrary() = default;
  ImageLibrary(const ImageLibrary&) = delete;
  ImageLibrary& operator=(const ImageLibrary&) = delete;

  //! Options for opening a file.
  struct Wishes {
    std::optional<std::span<const std::byte>>
        bytes;  //!< contents of the file, if it is not on the disk; must outlive the input
    //! True: integer colors are not multiplied by alpha on reading, because that must follow their
    //! decoding from sRGB; see ImageShape::separate_alpha.
    bool separate_alpha = false;
    //! True: the image is not rotated upright, and integers count as sRGB, whatever the metadata.
    bool as_stored = false;
    bool as_light = false;     //!< colors become linear Rec. 709 light, unless the shape is `encoded`
    bool as_panorama = false;  //!< a crop of a panorama is put at its position in it (GPano)
    std::string layer{};       //!< layer of an OpenEXR file, used with `as_light`; empty for the main layer
  };

  //! Opens an image; the ending of its name gives the format of `bytes`. Returns null and sets
  //! `problem` if it cannot be read.
  virtual std::unique_ptr<ImageInput> open(const std::string& name, const Wishes& wishes,
                                           std::string& problem) const = 0;

  //! Creates a writer of a format ("png", "openexr", "tiff") to a file or to `bytes`. Returns null
  //! and sets `problem` if the format is unknown.
  virtual std::unique_ptr<ImageOutput> create(const std::string& format, std::vector<unsigned char>* bytes,
                                              std::string& problem) const = 0;

  //! Returns the box of a text, or an empty one if there is no font or nothing to draw.
  [[nodiscard]] virtual TextBox text_box(const std::string& text, int font_px) const = 0;
  virtual bool draw_text(const ImageCanvas& canvas, int x, int y, const std::string& text,
                         const TextStyle& style) const = 0;
  virtual void draw_line(const ImageCanvas& canvas, int x0, int y0, int x1, int y1,
                         std::span<const float> colour) const = 0;
  virtual void draw_box(const ImageCanvas& canvas, int x0, int y0, int x1, int y1,
                        std::span<const float> colour) const = 0;

  //! Writes a FITS file: a primary header without an image, and image extensions, each with the
  //! checksums of the FITS checksum convention. Overwrites an existing file. Returns false and sets
  //! `problem` if that fails.
  virtual bool write_fits(const std::string& path, std::span<const FitsCard> primary, std::span<const FitsImage> images,
                          std::string& problem) const = 0;

  //! Returns a text keyword of the primary header of a FITS file that has `images` image extensions
  //! and correct checksums. Returns an empty text if the keyword is missing or the file is damaged.
  [[nodiscard]] virtual std::string whole_fits_text(const std::string& path, const std::string& name,
                                                    int images) const = 0;

  //! Computes the Fourier transform of `side` x `side` numbers: real and imaginary part of each
  //! frequency, zero frequency first. Returns an empty vector and sets `problem` if that fails.
  virtual std::vector<float> transform(const float* cells, int side, std::string& problem) const = 0;
};

//! Version of the interface between program and module: differs between builds whose shared
//! structures have different sizes.
inline constexpr std::uint64_t image_interface =
    (std::uint64_t{sizeof(FitsImage)} << 54U) | (std::uint64_t{sizeof(ImagePlan)} << 40U) |
    (std::uint64_t{sizeof(ImageShape)} << 20U) | std::uint64_t{sizeof(ImageLibrary::Wishes)};

//! Returns the image library; loads it at the first call. Throws Error if it cannot be loaded or
//! belongs to another build.
const ImageLibrary& image_library();

//! How the numbers of a file's pixels encode light. Files must be opened with
//! `Wishes::separate_alpha`.
struct LightCoding {
  int channels = 3;
  int alpha = -1;         //!< index of the alpha channel, or -1
  bool decoded = false;   //!< the colors must be decoded from sRGB
  bool separate = false;  //!< the colors are not premultiplied by alpha

  //! Returns the alpha of a pixel of `channels` numbers; 1 without an alpha channel.
  [[nodiscard]] float alpha_of(const float* pixel) const;

  //! Returns how many of a pixel's numbers put_light() reads: the colors, and also alpha if the
  //! light depends on it.
  [[nodiscard]] int light_channels() const;

  //! Computes a pixel's linear red, green and blue premultiplied by alpha: what is seen of it over
  //! black. The sRGB curve applies to unpremultiplied colors, so alpha multiplies the decoded ones.
  void put_light(const float* pixel, float* rgb) const;
};

//! Returns the coding of an image of this shape.
LightCoding light_coding(const ImageShape& shape);

}  // namespace ergodome
