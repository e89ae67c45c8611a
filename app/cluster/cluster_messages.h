#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "calibration/dome/dome_setup.h"
#include "calibration/projectors/grid_offsets.h"
#include "content/camera/camera_path.h"
#include "content/show/show.h"
#include "content/timeline/timeline.h"
#include "kernels/image/shade_pixels.h"
#include "kernels/sky/sky_sampling.h"
#include "kernels/spacetime/kerr/observer.h"
#include "render/lens/stations/lens_position.h"

// The messages between the computers of a dome. The master renders the same pictures as the nodes
// and releases them.

namespace ergodome {

//! Quality settings that replace the show's (FrameQuality).
struct ClusterQuality {
  double budget_px = 0.25;
  std::int32_t lens = 0;  //!< LensChoice by its number
  SkyFilter filter = SkyFilter::ewa;
  std::int32_t whole_px = 0;  //!< width of the picture whose pixels the budget counts

  bool operator==(const ClusterQuality&) const = default;
};

//! What the projectors show instead of the show's picture.
enum class ClusterPattern : std::uint8_t { none, test_pattern, projector_numbers };

//! Everything that a node needs to render the master's picture. Star limits and all else that is
//! not listed here are part of the show, whose fingerprint nodes prove when they join.
struct ClusterFrame {
  std::uint64_t number = 0;  //!< increases by 1 for each frame of a master
  std::uint32_t epoch = 0;   //!< version of the show; increases when the master reads it again
  std::int64_t time_ns = 0;  //!< show time
  bool on_path = false;      //!< the pose is that of the show's path at this time
  //! Change of show time per second, with which a node runs on if the master is silent.
  double rate = 0.0;
  //! True: the show is the attract show of an exhibit.
  bool attract = false;
  CameraPose pose{};
  //! Position of the camera in the previous frame, see ShowMoment::before.
  std::optional<LensPosition> before{};
  ObserverMotion motion = ObserverMotion::zamo;
  Vector3<double> velocity{};  //!< velocity of the observer, see ObserverView::velocity
  ViewMode mode = ViewMode::sky;
  double field_of_view_deg = 0.0;
  StereoSettings stereo;
  double exposure_stops = 0.0;
  //! Stops of automatic exposure with which all computers show this picture. Absent: each follows
  //! its own picture.
  std::optional<double> followed_stops;
  std::string language;
  bool captions = true;
  std::int32_t size_px = 0;        //!< width of one eye's image
  std::int32_t projectors_px = 0;  //!< OutputWish::projectors_px, of all projectors of the dome
  std::optional<ClusterQuality> quality;
  double texts_opacity = 0.0;  //!< of the last ClusterTexts
  std::uint32_t texts = 0;     //!< version of the ClusterTexts in the picture; 0: none
  ClusterPattern pattern = ClusterPattern::none;
  std::int32_t pattern_kind = 0;  //!< TestPattern by its number
  std::uint32_t calibration = 0;  //!< version of the ClusterCalibration in use; 0: the setup that was read
};

//! Fingerprints of what every computer of a cluster must have in common.
struct ClusterIdentity {
  std::string version;  //!< version of the program
  std::string show;
  std::string content;  //!< of the files that the show names
  std::string setup;

  bool operator==(const ClusterIdentity&) const = default;
};

//! A node asks to join.
struct ClusterHello {
  std::string node;
  ClusterIdentity identity;
};

//! The master accepts a node.
struct ClusterWelcome {
  std::uint64_t session = 0;  //!< number of the master's run
  SwapSync sync = SwapSync::barrier;
};

//! The master refuses a node.
struct ClusterRefused {
  std::string reason;
};

//! A node has rendered a frame.
struct ClusterReady {
  std::uint64_t number = 0;
  double frame_ms = 0.0;  //!< time that the node's renderer took
};

//! The master releases a frame: every computer shows it now.
struct ClusterSwap {
  std::uint64_t number = 0;
};

//! Sent by both sides while they live.
struct ClusterHeartbeat {
  std::uint64_t session = 0;  //!< the master's run; 0 from a node that has not joined
  double light = 1.0;         //!< factor on the displays' light, chosen by the master
  bool grouped = false;       //!< master: join the swap group; node: has joined it
};

//! Captions that are not part of the show, such as the welcome of an exhibit.
struct ClusterTexts {
  std::uint32_t version = 0;
  std::vector<Caption> captions;  //!< in one language; without times
};

//! The dome while an operator calibrates it.
struct ClusterCalibration {
  std::uint32_t version = 0;
  std::string setup;                 //!< to_toml() of the whole setup
  std::vector<GridOffsets> offsets;  //!< of each projector
  std::vector<std::string> texts;    //!< shown on each projector
};

//! The files of the master's shows, for nodes that lack some.
struct ClusterOffer {
  struct File {
    std::string name;         //!< relative to a folder of the node's choice
    std::string key;          //!< distinguishes its content from that of others
    std::uint64_t bytes = 0;  //!< size
  };
  std::vector<File> files;
  std::vector<std::uint16_t> shows;  //!< indices of the shows' own files
};

//! A node asks for bytes of a file, from an offset on.
struct ClusterWanted {
  std::string key;
  std::uint64_t offset = 0;
};

//! Bytes of a file.
struct ClusterChunk {
  std::string key;
  std::uint64_t offset = 0;
  std::string bytes;
};

using ClusterMessage =
    std::variant<ClusterFrame, ClusterHello, ClusterWelcome, ClusterRefused, ClusterReady, ClusterSwap,
                 ClusterHeartbeat, ClusterTexts, ClusterCalibration, ClusterOffer, ClusterWanted, ClusterChunk>;

//! Maximum size of a message [bytes].
inline constexpr std::size_t max_cluster_message = 256 * 1024;

//! Maximum lengths of texts in messages [bytes]. Longer texts are cut when they are sent.
inline constexpr std::size_t max_cluster_name = 64;
inline constexpr std::size_t max_cluster_reason = 600;
inline constexpr std::size_t max_cluster_caption = 4000;
inline constexpr std::size_t max_cluster_setup = 60'000;
inline constexpr std::size_t max_cluster_file_name = 300;
inline constexpr std::size_t max_cluster_chunk = 60'000;
//! Maximum number of files of the shows.
inline constexpr std::size_t max_cluster_files = 500;
//! Maximum numbers of captions, and of projectors in a calibration.
inline constexpr std::size_t max_cluster_captions = 8;
inline constexpr std::size_t max_cluster_projectors = 64;

}  // namespace ergodome
