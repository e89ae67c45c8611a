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

// What the program asks of OpenImageIO, and of CFITSIO, which OpenImageIO brings. To load these takes a quarter of a second, for the hundreds of libraries that it brings; most commands
// need no image. So it lies behind these interfaces in a library of its own, which the first call of image_library() loads.
namespace ergodome {

//! How a file's image is shown: turned as the file says (Orientation of TIFF and Exif), and in OpenEXR's display window, black where that has no pixels.
struct ImageShape {
  int width = 0;
  int height = 0;
  int depth = 1;
  int channels = 0;
  int alpha_channel = -1;  //!< or none
  int sample_bytes = 1;
  bool encoded = false;         //!< as sRGB
  bool separate_alpha = false;  //!< colours are not times alpha
};

//! An image that was opened. What returns bool says false where the file is torn; error() then says why.
class ImageInput {
 public:
  ImageInput() = default;
  virtual ~ImageInput() = default;
  ImageInput(const ImageInput&) = delete;
  ImageInput& operator=(const ImageInput&) = delete;

  [[nodiscard]] virtual const ImageShape& shape() const = 0;

  //! Goes to another of a file's images.
  virtual bool go_to_part(int part) = 0;

  //! Reads the first `channels` of rows [begin, end), or of all, from the top. Rows of tiled images are cheap in order only: the
  //! tiles that were read last are kept.
  virtual bool read_rows(int begin, int end, int channels, float* to) = 0;
  virtual bool read_all(int channels, float* to) = 0;
  virtual bool read_all(int channels, std::uint16_t* to) = 0;

  //! Reads all rows, and keeps none.
  virtual bool read_through() = 0;

  //! Returns an attribute of the part by OpenImageIO's name, or the name of the file's "format"; empty if it has none.
  [[nodiscard]] virtual std::string text(const std::string& name) const = 0;

  //! The last message, which is taken away.
  virtual std::string error() = 0;
};

enum class ImageSample { whole_8, whole_16, half, real };

//! An image that is to be written.
struct ImagePlan {
  int width = 0;
  int height = 0;
  int channels = 3;
  ImageSample sample = ImageSample::whole_8;
  std::vector<std::pair<std::string, std::string>> texts;  //!< facts by OpenImageIO's names
  std::vector<std::pair<std::string, int>> numbers;
  std::vector<float> chromaticities;  //!< of red, green, blue and white, or none
  std::vector<std::pair<std::string, std::array<int, 2>>> ratios{};
  std::vector<std::string> channel_names{};  //!< of all channels, or none: R, G, B, A
};

//! A keyword of a FITS header. Names have up to 8 characters of A-Z, 0-9, - and _.
struct FitsCard {
  std::string name;
  std::variant<std::string, double, int> value;  //!< a text, or a finite number
  std::string comment{};
};

//! An image extension of a FITS file: doubles, NaN where there is no value.
struct FitsImage {
  std::vector<FitsCard> cards;
  int width = 0;
  int height = 0;
  std::span<const double> pixels;  //!< row by row from the top; the file begins with the lowest row
};

//! A file that is being written; as ImageInput.
class ImageOutput {
 public:
  ImageOutput() = default;
  virtual ~ImageOutput() = default;
  ImageOutput(const ImageOutput&) = delete;
  ImageOutput& operator=(const ImageOutput&) = delete;

  //! Begins a file with one part, or with several, of which the first is begun.
  virtual bool open(const std::string& path, std::span<const ImagePlan> parts) = 0;
  virtual bool open_next(const std::string& path, const ImagePlan& part) = 0;

  //! All of a part's pixels.
  virtual bool write(const float* pixels) = 0;
  virtual bool write(const std::uint8_t* pixels) = 0;
  virtual bool write(const std::uint16_t* pixels) = 0;

  virtual bool close() = 0;
  virtual std::string error() = 0;
};

//! What is drawn on: floats, the top row first.
struct ImageCanvas {
  float* pixels;
  int width;
  int height;
  int channels;
};

//! Which point of a text lies at its place.
enum class TextPlace { baseline_start, top_centre, centre };

struct TextStyle {
  int font_px;
  std::span<const float> colour;  //!< a number a channel
  TextPlace place = TextPlace::baseline_start;
  int shadow_px = 0;
};

//! The pixels that a text covers when its baseline starts at (0, 0).
struct TextBox {
  int left, top, width, height;
};

class ImageLibrary {
 public:
  ImageLibrary() = default;
  virtual ~ImageLibrary() = default;
  ImageLibrary(const ImageLibrary&) = delete;
  ImageLibrary& operator=(const ImageLibrary&) = delete;

  //! How a file is to be opened.
  struct Wishes {
    std::optional<std::span<const std::byte>>
        bytes;                    //!< of the file, which is not on a disk then; they outlive what is opened
    bool separate_alpha = false;  //!< whole numbers shall not be multiplied by alpha before they are decoded
    bool as_stored = false;       //!< an image shall not be turned upright
    bool as_light = false;     //!< colors shall be linear light of Rec. 709, unless the shape says that they are sRGB
    bool as_panorama = false;  //!< a crop of a panorama shall be put in its position (GPano)
    std::string layer{};       //!< of OpenEXR; empty for the main one
  };

  //! Opens an image; its name's ending tells the format of bytes. None where it cannot be read: `problem` says why.
  virtual std::unique_ptr<ImageInput> open(const std::string& name, const Wishes& wishes,
                                           std::string& problem) const = 0;

  //! A writer of a format ("png", "openexr", "tiff"), to a file or to `bytes`. None where it is not known: `problem` says why.
  virtual std::unique_ptr<ImageOutput> create(const std::string& format, std::vector<unsigned char>* bytes,
                                              std::string& problem) const = 0;

  //! Nothing where there is no such font, or nothing to write.
  [[nodiscard]] virtual TextBox text_box(const std::string& text, int font_px) const = 0;
  virtual bool draw_text(const ImageCanvas& canvas, int x, int y, const std::string& text,
                         const TextStyle& style) const = 0;
  virtual void draw_line(const ImageCanvas& canvas, int x0, int y0, int x1, int y1,
                         std::span<const float> colour) const = 0;
  virtual void draw_box(const ImageCanvas& canvas, int x0, int y0, int x1, int y1,
                        std::span<const float> colour) const = 0;

  //! Writes a FITS file: a primary header without an image, and image extensions, each with the checksums of the FITS checksum convention. False where
  //! that fails: `problem` says why. The file is there already, and is filled.
  virtual bool write_fits(const std::string& path, std::span<const FitsCard> primary, std::span<const FitsImage> images,
                          std::string& problem) const = 0;

  //! Returns a text keyword of the primary header of a FITS file with so many image extensions whose checksums are right; empty where there is none, or
  //! the file is damaged.
  [[nodiscard]] virtual std::string whole_fits_text(const std::string& path, const std::string& name,
                                                    int images) const = 0;

  //! Fourier's transform of a square of `side` x `side` numbers: real and imaginary part of each frequency, unshifted. Empty where it fails:
  //! `problem` says why.
  virtual std::vector<float> transform(const float* cells, int side, std::string& problem) const = 0;
};

//! Differs between builds whose module and program do not hand over the same.
inline constexpr std::uint64_t image_interface =
    (std::uint64_t{sizeof(FitsImage)} << 54U) | (std::uint64_t{sizeof(ImagePlan)} << 40U) |
    (std::uint64_t{sizeof(ImageShape)} << 20U) | std::uint64_t{sizeof(ImageLibrary::Wishes)};

//! OpenImageIO. Throws Error where it cannot be loaded, or is another build's.
const ImageLibrary& image_library();

}  // namespace ergodome
