#include "render/channels/channel_files.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfStringAttribute.h>
#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <limits>

#include "content/images/image_library.h"
#include "kernels/core/error.h"
#include "kernels/projection/make_projection.h"
#include "render/output/image_writer.h"
#include "tests/support/fits_reader.h"
#include "tests/support/folder_test.h"

namespace ergodome {
namespace {

using testing::StartsWith;

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

class ChannelFiles : public test::FolderTest {
 protected:
  //! Returns two channels of a picture with 3 x 2 pixels.
  static std::vector<PixelChannel> two_channels() {
    return {{channels_of(ChannelGroup::g)[0], {1.0, 2.0, 1.0 / 3.0, 4.0, no_number, 6.0}},
            {channels_of(ChannelGroup::disk)[0], {10.0, 20.0, 30.0, 1e300, 50.0, no_number}}};
  }
  static std::vector<MetadataEntry> some_metadata() {
    return {{"spin", "SPIN", 0.999, "a/M of the hole"}, {"request", "REQUEST", std::string(90, 'f'), ""}};
  }
  [[nodiscard]] std::string path(const char* name) const { return (folder_ / name).string(); }

  void write_fits(const char* name) const {
    write_channel_fits(path(name), 3, 2, two_channels(), picture_wcs(make_pinhole_projection(3, 2, 1.0)),
                       some_metadata());
  }
};

TEST_F(ChannelFiles, OfFitsHoldEveryChannelAsAnExtensionWithUnitAndChecksums) {
  write_fits("numbers.fits");
  test::FitsReader fits(path("numbers.fits"));
  ASSERT_EQ(fits.units(), 3);
  fits.go_to_primary();
  EXPECT_TRUE(fits.has_right_checksums());
  EXPECT_EQ(fits.number("SPIN"), 0.999);
  fits.go_to("g");
  EXPECT_TRUE(fits.has_right_checksums());
  EXPECT_FALSE(fits.has("BUNIT"));
  EXPECT_EQ(fits.text("CTYPE1"), "VLON-TAN");
  EXPECT_EQ(fits.text("CTYPE2"), "VLAT-TAN");
  EXPECT_EQ(fits.number("CRPIX1"), 2.0);
  EXPECT_EQ(fits.number("CRPIX2"), 1.5);
  EXPECT_EQ(fits.number("LONPOLE"), 180.0);
  // FITS files start with the lowest row of the picture. Values are doubles and must not change in
  // the last bit.
  const std::vector<double> g = fits.pixels();
  EXPECT_EQ(g[0], 4.0);
  EXPECT_TRUE(std::isnan(g[1]));
  EXPECT_EQ(g[3], 1.0);
  EXPECT_EQ(g[5], 1.0 / 3.0);
  fits.go_to("disk.radius");
  EXPECT_TRUE(fits.has_right_checksums());
  EXPECT_EQ(fits.text("BUNIT"), "GM/c**2");
  EXPECT_EQ(fits.pixels()[0], 1e300);
}

TEST_F(ChannelFiles, OfFitsAreKnownToBeWhole) {
  write_fits("numbers.fits");
  const std::string bytes = text("numbers.fits");
  EXPECT_EQ(image_library().whole_fits_text(path("numbers.fits"), "REQUEST", 2), std::string(90, 'f'));
  EXPECT_EQ(image_library().whole_fits_text(path("numbers.fits"), "REQUEST", 3), "");
  EXPECT_EQ(image_library().whole_fits_text(path("numbers.fits"), "NONE", 2), "");
  EXPECT_EQ(image_library().whole_fits_text(path("absent.fits"), "REQUEST", 2), "");
  ASSERT_EQ(bytes.size() % 2880, 0U);
  for (std::size_t at = 100; at < bytes.size(); at += 1440) {
    std::string damaged = bytes;
    damaged[at] = static_cast<char>(damaged[at] ^ 1);
    std::ofstream(path("damaged.fits"), std::ios::binary) << damaged;
    EXPECT_EQ(image_library().whole_fits_text(path("damaged.fits"), "REQUEST", 2), "") << at;
  }
  for (const std::size_t size : {std::size_t{0}, std::size_t{80}, bytes.size() - 2880}) {
    std::ofstream(path("short.fits"), std::ios::binary) << bytes.substr(0, size);
    EXPECT_EQ(image_library().whole_fits_text(path("short.fits"), "REQUEST", 2), "") << size;
  }
}

TEST_F(ChannelFiles, OfFitsTakeNamesAsTheyAre) {
  // In the extended file names of CFITSIO, brackets would crop or filter an image; here they are
  // part of the name.
  write_fits("frame[1:2](x).fits");
  EXPECT_NE(image_library().whole_fits_text(path("frame[1:2](x).fits"), "REQUEST", 2), "");
  EXPECT_THROW(write_channel_fits(path("no/such.fits"), 3, 2, two_channels(), std::nullopt, some_metadata()), Error);
}

TEST_F(ChannelFiles, OfExrHoldFloatsUnderTheirFullNames) {
  write_channel_exr(path("numbers.exr"), ExrCompression::zip, 3, 2, two_channels(), some_metadata());
  Imf::InputFile exr(path("numbers.exr").c_str());
  const Imf::Channel* const g = exr.header().channels().findChannel("g");
  ASSERT_NE(g, nullptr);
  EXPECT_EQ(g->type, Imf::FLOAT);
  ASSERT_NE(exr.header().channels().findChannel("disk.radius"), nullptr);
  std::vector<float> values(6);
  Imf::FrameBuffer buffer;
  buffer.insert("g", Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(values.data()), sizeof(float), 3 * sizeof(float)));
  exr.setFrameBuffer(buffer);
  exr.readPixels(0, 1);
  EXPECT_EQ(values[0], 1.0F);
  EXPECT_EQ(values[2], static_cast<float>(1.0 / 3.0));
  EXPECT_TRUE(std::isnan(values[4]));
  EXPECT_EQ(values[5], 6.0F);
  const auto* const spin = exr.header().findTypedAttribute<Imf::StringAttribute>("ergodome:spin");
  ASSERT_NE(spin, nullptr);
  EXPECT_THAT(spin->value(), StartsWith("0.999"));
  EXPECT_EQ(metadata_of_image(path("numbers.exr"), "request"), std::string(90, 'f'));
  EXPECT_TRUE(is_complete_image(path("numbers.exr"), 3, 2));
}

}  // namespace
}  // namespace ergodome
