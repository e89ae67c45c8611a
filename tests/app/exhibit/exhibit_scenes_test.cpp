#include "app/exhibit/exhibit_scenes.h"

#include <gmock/gmock.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstdlib>

#include "app/cli/show_loading.h"
#include "app/cli/show_options.h"
#include "app/exhibit/supervisor.h"
#include "app/navigation/flight_space.h"
#include "render/passes/overlay/caption_image.h"
#include "tests/support/folder_test.h"

namespace ergodome {
namespace {

using Kind = TransportCommand::Kind;
using testing::Contains;
using testing::HasSubstr;

//! An exhibit with a simulated player status, which tests set through `status_`.
class SavedByAnExhibit : public test::FolderTest {
 protected:
  void SetUp() override {
    FolderTest::SetUp();
    status_.languages = {"en", "de"};
    status_.language = "en";
    ExhibitOptions options;
    options.state = folder_;
    exhibit_.emplace(options, Show{}, Show{});
    exhibit_->advance(0.0, true, false);
  }

  //! Advances the simulated time, and lets the exhibit save the current status.
  void keep_after(double seconds) {
    now_s_ += seconds;
    exhibit_->advance(now_s_, false, false);
    exhibit_->keep(status_, false);
  }

  PlayerStatus status_;
  std::optional<ExhibitScenes> exhibit_;
  double now_s_ = 0.0;
};

TEST(ExhibitWelcome, NamesTheFallIntoTheHoleWhereTheShowLetsVisitorsIn) {
  for (const double spin : {0.5, 1.0}) {
    Show show;
    show.spin = spin;
    ExhibitScenes exhibit({}, show, Show{});
    exhibit.advance(0.0, true, false);
    exhibit.advance(2.0, false, false);
    const std::vector<Caption> captions = exhibit.captions(true);
    const bool named = captions.back().text.at("de").find("ins Loch fallen") != std::string::npos;
    EXPECT_EQ(named, spin < 1.0);
  }
}

TEST_F(SavedByAnExhibit, ItsWelcomeHasLinesApartWithLettersThatSmallDomesCanShow) {
  constexpr double pixels_a_degree = 512.0 / 180.0;
  exhibit_->advance(2.0, false, false);
  for (const bool pad : {false, true}) {
    double above_deg = 90.0;
    for (const Caption& line : exhibit_->captions(pad)) {
      EXPECT_GT(line.letter_deg * pixels_a_degree, 6.5);
      EXPECT_LT(line.position.elevation_deg + line.letter_deg, above_deg) << "a letter's height between two lines";
      above_deg = line.position.elevation_deg - 0.5 * line.letter_deg;
      for (const auto& [language, words] : line.text) {
        constexpr int line_px = 32;
        const CaptionImage image = set_caption(words, {line_px, line_px * line.width_deg / line.letter_deg});
        EXPECT_LT(image.image.height, 2 * line_px) << words << ": is broken into two";
      }
    }
    EXPECT_GT(above_deg, 5.0) << "the rim";
    EXPECT_LT(above_deg, 90.0);
  }
}

TEST_F(SavedByAnExhibit, AVisitorsLanguageIsNot) {
  status_.language = "de";
  keep_after(1.0);
  keep_after(10.0);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "settings.toml"));
  EXPECT_THAT(exhibit_->saved_commands(), testing::Not(Contains(TransportCommand{Kind::language, 0.0, "de"})));
}

TEST_F(SavedByAnExhibit, AnOperatorsLanguageIs) {
  status_.language = "de";
  exhibit_->note({{Kind::language, 0.0, "de"}});
  keep_after(1.0);
  keep_after(10.0);
  EXPECT_THAT(text("settings.toml"), HasSubstr("language = 'de'"));
  EXPECT_THAT(exhibit_->saved_commands(), Contains(TransportCommand{Kind::language, 0.0, "de"}));
}

TEST_F(SavedByAnExhibit, AnOperatorsVolumeIsWithoutAVisitorsLanguage) {
  status_.language = "de";
  status_.volume = 0.5;
  exhibit_->note({{Kind::volume, 0.5, {}}});
  keep_after(1.0);
  EXPECT_THAT(exhibit_->saved_commands(), Contains(TransportCommand{Kind::volume, 0.5, {}}));
  EXPECT_THAT(exhibit_->saved_commands(), testing::Not(Contains(TransportCommand{Kind::language, 0.0, "de"})));
}

TEST_F(SavedByAnExhibit, AnOperatorsExposureOutlastsAVisitorsReset) {
  status_.exposure_stops = -2.0;
  exhibit_->note({{Kind::exposure, -2.0, {}}});
  keep_after(1.0);
  EXPECT_THAT(exhibit_->reset_commands(),
              testing::ElementsAre(TransportCommand{Kind::reset, 0.0, {}}, TransportCommand{Kind::exposure, -2.0, {}}));
}

TEST_F(SavedByAnExhibit, SettingsAreWrittenAtOnceAndAFaderThatMovesOnceASecond) {
  const auto set_volume = [&](double volume, double after_s) {
    status_.volume = volume;
    exhibit_->note({{Kind::volume, volume, {}}});
    keep_after(after_s);
  };
  set_volume(0.5, 0.01);
  EXPECT_THAT(text("settings.toml"), HasSubstr("volume = 0.5"));
  set_volume(0.25, 0.5);
  EXPECT_THAT(text("settings.toml"), HasSubstr("volume = 0.5"));
  keep_after(0.6);
  EXPECT_THAT(text("settings.toml"), HasSubstr("volume = 0.25"));
  set_volume(0.75, 0.01);
  exhibit_->keep_last();
  EXPECT_THAT(text("settings.toml"), HasSubstr("volume = 0.75"));
}

TEST_F(SavedByAnExhibit, AVisitorWhoSeesOnlyBlackIsToldHowToGetBackAndThenTakenThere) {
  exhibit_->advance(10.0, true, false);
  exhibit_->note_light(0.0);
  exhibit_->advance(15.0, true, false);
  ASSERT_FALSE(exhibit_->captions(false).empty());
  EXPECT_THAT(exhibit_->captions(false).at(1).text.at("en"), HasSubstr("Delete"));
  EXPECT_THAT(exhibit_->captions(true).at(1).text.at("en"), HasSubstr("right stick"));
  EXPECT_THAT(exhibit_->captions(true).at(2).text.at("en"), HasSubstr("in 15 s"));
  EXPECT_EQ(exhibit_->opacity(), 1.0);
  EXPECT_FALSE(exhibit_->take_return());
  exhibit_->advance(30.0, true, false);
  EXPECT_TRUE(exhibit_->take_return());
  EXPECT_FALSE(exhibit_->take_return());
}

TEST_F(SavedByAnExhibit, ABlackAttractShowIsNobodysToLeave) {
  exhibit_->advance(100.0, false, false);
  ASSERT_EQ(exhibit_->scene(), ExhibitScene::attract);
  exhibit_->note_light(0.0);
  exhibit_->advance(150.0, false, false);
  EXPECT_FALSE(exhibit_->take_return());
  EXPECT_TRUE(exhibit_->captions(false).empty());
}

TEST(ExhibitShows, AreFlatOnFlatScreensWithStarsAndADisk) {
  const Show visitor = load_show(usual_visitor_show);
  EXPECT_EQ(visitor.view.projection, ViewProjection::pinhole);
  EXPECT_TRUE(visitor.disk.has_value());
  EXPECT_FALSE(visitor.sky.stars.empty());
  EXPECT_TRUE(may_fall_through_horizon(visitor));
  const Show attract = load_show(usual_attract_show(visitor));
  EXPECT_EQ(attract.view.projection, ViewProjection::pinhole);
  EXPECT_EQ(attract_mismatch(visitor, attract), "");
}

TEST(ExhibitShows, AreForDomesOnDomes) {
  Show visitor = load_show(usual_visitor_show);
  ShowOverrides overrides;
  overrides.projection = "dome";
  apply_overrides(visitor, overrides, false);
  const Show attract = load_show(usual_attract_show(visitor));
  EXPECT_EQ(attract.view.projection, ViewProjection::dome);
  EXPECT_EQ(attract_mismatch(visitor, attract), "");
}

TEST(ExhibitShows, ThatDoNotFitTheDisplayAreAWarningWithARemedy) {
  Show flat;
  flat.view.projection = ViewProjection::pinhole;
  flat.name = "flat";
  Show dome;
  dome.view.projection = ViewProjection::dome;
  dome.name = "evening";
  EXPECT_THAT(attract_mismatch(flat, dome),
              testing::AllOf(HasSubstr("evening: is not made for flat screens"), HasSubstr("--projection pinhole")));
  EXPECT_THAT(attract_mismatch(dome, flat),
              testing::AllOf(HasSubstr("flat: is made for flat screens"), HasSubstr("--projection dome")));
}

TEST_F(SavedByAnExhibit, SettingsThatTheDiskRefusesAreAProblemThatNamesTheFile) {
  std::filesystem::create_directory(folder_ / "settings.toml");
  status_.volume = 0.5;
  exhibit_->note({{Kind::volume, 0.5, {}}});
  keep_after(1.0);
  EXPECT_THAT(exhibit_->problem(),
              testing::AllOf(HasSubstr("settings.toml: the settings cannot be saved"), HasSubstr("free disk space")));
}

TEST_F(SavedByAnExhibit, SettingsAreWrittenOnceTheDiskTakesThemAgain) {
  std::filesystem::create_directory(folder_ / "settings.toml");
  status_.volume = 0.5;
  exhibit_->note({{Kind::volume, 0.5, {}}});
  keep_after(1.0);
  EXPECT_NE(exhibit_->problem(), "");
  std::filesystem::remove(folder_ / "settings.toml");
  keep_after(11.0);
  EXPECT_EQ(exhibit_->problem(), "");
  EXPECT_THAT(text("settings.toml"), HasSubstr("volume = 0.5"));
}

TEST_F(SavedByAnExhibit, ASentenceSaysWhatItDoes) {
  status_.blackout = true;
  status_.problem = "no lens";
  EXPECT_THAT(exhibit_->state_text(status_),
              testing::AllOf(HasSubstr("visitor"), HasSubstr("blacked out"), HasSubstr("no lens")));
}

TEST_F(SavedByAnExhibit, TheServiceManagerIsToldWhenThatChanges) {
  const int socket = ::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const std::string name = (folder_ / "notify").string();
  name.copy(address.sun_path, sizeof address.sun_path - 1);
  ASSERT_EQ(::bind(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  ::setenv("NOTIFY_SOCKET", name.c_str(), 1);
  for (const char* state : {"one", "one", "two\nlines"}) {
    notify_supervisor(state);
  }
  ::unsetenv("NOTIFY_SOCKET");
  std::string reported;
  char message[200];
  for (ssize_t got = 0; (got = ::recv(socket, message, sizeof message, MSG_DONTWAIT)) > 0;) {
    reported += std::string(message, static_cast<std::size_t>(got)) + ";";
  }
  ::close(socket);
  EXPECT_EQ(reported, "STATUS=one;STATUS=two lines;");
}

}  // namespace
}  // namespace ergodome
