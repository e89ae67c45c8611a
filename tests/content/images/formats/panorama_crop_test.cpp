#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>

#include <fstream>
#include <iterator>

#include "content/sky/environment_image.h"
#include "tests/support/errors.h"
#include "tests/support/folder_test.h"

namespace ergodome {
namespace {

namespace fs = std::filesystem;

class PanoramaCrops : public test::FolderTest {
 protected:
  //! Writes a gray JPEG image and inserts an XMP packet after the first marker of the file.
  fs::path write(int width, int height, const std::string& description) {
    fs::path path = folder_ / "crop.jpg";
    const std::vector<float> grey(static_cast<std::size_t>(3 * width * height), 0.5F);
    const auto output = OIIO::ImageOutput::create(path.string());
    EXPECT_TRUE(output && output->open(path.string(), OIIO::ImageSpec(width, height, 3, OIIO::TypeDesc::UINT8)) &&
                output->write_image(OIIO::TypeDesc::FLOAT, grey.data()) && output->close());
    std::ifstream plain(path, std::ios::binary);
    const std::string jpeg{std::istreambuf_iterator<char>(plain), {}};
    std::string segment("http://ns.adobe.com/xap/1.0/\0", 29);
    segment +=
        "<x:xmpmeta xmlns:x=\"adobe:ns:meta/\"><rdf:RDF xmlns:rdf=\"http://www.w3.org/1999/02/22-rdf-syntax-ns#\">" +
        description + "</rdf:RDF></x:xmpmeta>";
    const std::size_t length = segment.size() + 2;
    const std::string marker = {'\xFF', '\xE1', static_cast<char>(length / 256), static_cast<char>(length % 256)};
    std::ofstream(path, std::ios::binary) << jpeg.substr(0, 2) << marker << segment << jpeg.substr(2);
    return path;
  }

  //! Expects that the map is lit in this rectangle and black everywhere else.
  static void expect_lit(const EnvironmentImage& image, int left, int top, int right, int bottom) {
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x) {
        const bool inside = x >= left && x < right && y >= top && y < bottom;
        EXPECT_EQ(image.rgb.at(static_cast<std::size_t>(3 * (y * image.width + x))) > 0.1F, inside) << x << " " << y;
      }
    }
  }
};

constexpr const char* as_attributes =
    "<rdf:Description xmlns:GPano=\"http://ns.google.com/photos/1.0/panorama/\" "
    "GPano:ProjectionType=\"equirectangular\" "
    "GPano:FullPanoWidthPixels=\"400\" GPano:FullPanoHeightPixels=\"200\" GPano:CroppedAreaImageWidthPixels=\"120\" "
    "GPano:CroppedAreaImageHeightPixels=\"80\" GPano:CroppedAreaLeftPixels=\"140\" GPano:CroppedAreaTopPixels=\"60\"/>";

constexpr const char* as_elements =
    "<rdf:Description xmlns:GPano=\"http://ns.google.com/photos/1.0/panorama/\">"
    "<GPano:ProjectionType>equirectangular</GPano:ProjectionType><GPano:FullPanoWidthPixels>400</"
    "GPano:FullPanoWidthPixels>"
    "<GPano:FullPanoHeightPixels>200</GPano:FullPanoHeightPixels>"
    "<GPano:CroppedAreaImageWidthPixels>120</GPano:CroppedAreaImageWidthPixels>"
    "<GPano:CroppedAreaImageHeightPixels>80</GPano:CroppedAreaImageHeightPixels>"
    "<GPano:CroppedAreaLeftPixels>140</GPano:CroppedAreaLeftPixels><GPano:CroppedAreaTopPixels>60</"
    "GPano:CroppedAreaTopPixels>"
    "</rdf:Description>";

TEST_F(PanoramaCrops, AreInThePositionOfTheirMetadata) {
  for (const char* const description : {as_attributes, as_elements}) {
    const EnvironmentImage image = read_environment_image(write(120, 80, description));
    ASSERT_EQ(image.width, 400);
    ASSERT_EQ(image.height, 200);
    expect_lit(image, 140, 60, 260, 140);
  }
}

TEST_F(PanoramaCrops, ThatWereScaledSinceAreInTheSamePosition) {
  const EnvironmentImage image = read_environment_image(write(60, 40, as_attributes));
  ASSERT_EQ(image.width, 200);
  ASSERT_EQ(image.height, 100);
  expect_lit(image, 70, 30, 130, 70);
}

TEST_F(PanoramaCrops, OfAnotherProjectionAreRefused) {
  const fs::path path = write(120, 80,
                              "<rdf:Description xmlns:GPano=\"http://ns.google.com/photos/1.0/panorama/\" "
                              "GPano:ProjectionType=\"cylindrical\"/>");
  EXPECT_THAT(test::error_of([&] { read_environment_image(path); }), testing::HasSubstr("cylindrical"));
}

TEST_F(PanoramaCrops, WithoutNumbersAreWholePanoramas) {
  const fs::path path = write(120, 60,
                              "<rdf:Description xmlns:GPano=\"http://ns.google.com/photos/1.0/panorama/\" "
                              "GPano:ProjectionType=\"equirectangular\"/>");
  EXPECT_EQ(read_environment_image(path).width, 120);
}

}  // namespace
}  // namespace ergodome
