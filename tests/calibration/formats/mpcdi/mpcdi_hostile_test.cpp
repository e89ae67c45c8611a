#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calibration/formats/mpcdi/zip_archive.h"
#include "tests/calibration/formats/mpcdi/mpcdi_fixtures.h"

namespace ergodome {
namespace {

using namespace test;
using testing::AllOf;
using testing::HasSubstr;

std::string problem_of(const std::string& bytes) {
  return error_of([&] { parsed_archive(bytes); });
}

std::string problem_of(const std::vector<ZipMember>& members) { return problem_of(zip_by_hand(members)); }

TEST(HostileMpcdi, BombOfZerosIsRefusedBeforeItIsUnpacked) {
  const std::string zeros(64U << 20U, '\0');
  EXPECT_THAT(problem_of(zip_of({{"mpcdi.xml", media_xml}, {"left.pfm", zeros}}, "bomb")),
              AllOf(HasSubstr("left.pfm: would unpack from"), HasSubstr("67108864")));
  EXPECT_THAT(problem_of(zip_of({{"mpcdi.xml", zeros}}, "bomb")), HasSubstr("mpcdi.xml: would unpack to 67108864"));
}

TEST(HostileMpcdi, MemberLargerThanItSaysIsRefused) {
  auto members = media_members(media_xml);
  members[1].stated_size = 10;
  EXPECT_THAT(problem_of(members), HasSubstr("test.mpcdi: left.pfm"));
}

TEST(HostileMpcdi, MemberSmallerThanItSaysIsRefused) {
  auto members = media_members(media_xml);
  members[1].stated_size = 300'000'000;
  EXPECT_THAT(problem_of(members), HasSubstr("test.mpcdi: left.pfm"));
}

TEST(HostileMpcdi, MemberPackedLargerThanTheArchiveIsRefused) {
  std::string bytes = zip_by_hand(media_members(media_xml));
  // The field with the compressed size is 20 bytes after the start of an entry in the central
  // directory; this is the second entry.
  const std::size_t entry = bytes.find("PK\x01\x02", bytes.find("PK\x01\x02") + 1);
  bytes.replace(entry + 20, 4, little(400'000'000, 4));
  bytes.replace(entry + 24, 4, little(400'000'000, 4));
  EXPECT_THAT(problem_of(bytes), HasSubstr("test.mpcdi: left.pfm"));
}

TEST(HostileMpcdi, WrongChecksumIsAnError) {
  auto members = media_members(media_xml);
  members[1].stated_crc ^= 1U;
  EXPECT_THAT(problem_of(members), AllOf(HasSubstr("left.pfm"), HasSubstr("CRC")));
}

TEST(HostileMpcdi, EncryptedMembersAndUnusualPackingAreRefused) {
  auto members = media_members(media_xml);
  members[1].flags = 1;
  EXPECT_THAT(problem_of(members), HasSubstr("left.pfm: is encrypted"));
  members[1].flags = 0;
  members[1].method = 12;
  EXPECT_THAT(problem_of(members), HasSubstr("left.pfm: is compressed by an unsupported method"));
}

TEST(HostileMpcdi, MoreEntriesThanAnyCalibrationHasAreRefused) {
  std::vector<ZipMember> members(5000, ZipMember("a", ""));
  EXPECT_THAT(problem_of(members), HasSubstr("5000 entries"));
}

TEST(HostileMpcdi, DocumentTypesAndTheirEntitiesAreRefused) {
  const std::string laughs =
      "<!DOCTYPE MPCDI [<!ENTITY a \"ha\"><!ENTITY b \"&a;&a;&a;&a;\"><!ENTITY c \"&b;&b;&b;&b;\">]>\n<MPCDI";
  EXPECT_THAT(problem_of(media_members(replaced(media_xml, "<MPCDI", laughs))), HasSubstr("declares a document type"));
  const std::string outside = "<!DOCTYPE MPCDI SYSTEM \"file:///etc/passwd\">\n<MPCDI";
  EXPECT_THAT(problem_of(media_members(replaced(media_xml, "<MPCDI", outside))), HasSubstr("declares a document type"));
}

TEST(HostileMpcdi, EntitiesOfNobodyStayAsTheyAre) {
  EXPECT_THAT(problem_of(media_members(replaced(media_xml, "left.pfm", "&xxe;.pfm"))),
              HasSubstr("&xxe;.pfm: is not in the archive"));
}

TEST(HostileMpcdi, DeepNestingIsRefused) {
  std::string deep = "<MPCDI>";
  for (int i = 0; i < 100'000; ++i) {
    deep += "<a>";
  }
  EXPECT_THAT(problem_of({{"mpcdi.xml", deep}}), HasSubstr("mpcdi.xml:1"));
  for (int i = 0; i < 100'000; ++i) {
    deep += "</a>";
  }
  EXPECT_THAT(problem_of({{"mpcdi.xml", deep + "</MPCDI>"}}), HasSubstr("nested deeper than 32"));
}

TEST(HostileMpcdi, TornXmlIsAnErrorWithItsLine) {
  EXPECT_THAT(problem_of(media_members(media_xml.substr(0, media_xml.find("<files>")))),
              AllOf(HasSubstr("test.mpcdi: mpcdi.xml:"), HasSubstr("not well-formed")));
}

TEST(HostileMpcdi, TornAndForeignArchivesAreErrors) {
  const std::string whole = zip_by_hand(media_members(media_xml));
  EXPECT_THAT(problem_of(whole.substr(0, whole.size() / 2)), HasSubstr("cannot be opened as a zip archive"));
  EXPECT_THAT(problem_of(std::string("PK")), HasSubstr("cannot be opened as a zip archive"));
  EXPECT_THAT(problem_of(std::string()), HasSubstr("contains no mpcdi.xml"));
  EXPECT_THAT(problem_of({{"readme.txt", "hello"}}), HasSubstr("contains no mpcdi.xml"));
}

TEST(HostileMpcdi, WarpOfOneSampleIsAnErrorWithTheNameOfItsFile) {
  auto members = media_members(media_xml);
  members[1] = ZipMember("left.pfm", pfm_by_hand(1, 1, {0, 0, 0}));
  EXPECT_THAT(problem_of(members), AllOf(HasSubstr("left.pfm"), HasSubstr("1 x 1")));
}

TEST(HostileMpcdi, MaskThatIsTornHugeTinyOrTransparentIsAnError) {
  auto members = media_members(media_xml);
  const std::string whole = members[3].bytes;
  members[3] = ZipMember("left.png", whole.substr(0, whole.size() / 2));
  EXPECT_THAT(problem_of(members), HasSubstr("left.png"));
  members[3] = ZipMember("left.png", png_by_hand(100'000, 100'000, 1, 8, {0}));
  EXPECT_THAT(problem_of(members), HasSubstr("100000 x 100000"));
  members[3] = ZipMember("left.png", png_by_hand(1, 1, 1, 8, {0}));
  EXPECT_THAT(problem_of(members), HasSubstr("at least 2 x 2"));
  std::string transparent = whole;
  transparent[25] = 4;  // gray with alpha
  transparent.replace(29, 4, big(crc32(transparent.substr(12, 17)), 4));
  members[3] = ZipMember("left.png", transparent);
  EXPECT_THAT(problem_of(members), AllOf(HasSubstr("left.png"), HasSubstr("2 channels")));
}

}  // namespace
}  // namespace ergodome
