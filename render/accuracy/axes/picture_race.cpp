#include "render/accuracy/axes/picture_race.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "kernels/launch/work_counter.h"
#include "render/accuracy/statistics.h"

namespace ergodome {

namespace {

//! Returns the luminance of a pixel in linear Rec. 709.
double luminance(const Picture& picture, std::int64_t pixel) {
  const float* const light = picture.rgba.data() + 4 * pixel;
  return 0.2126729 * static_cast<double>(light[0]) + 0.7151522 * static_cast<double>(light[1]) +
         0.0721750 * static_cast<double>(light[2]);
}

bool is_whole(const Picture& picture, std::int64_t pixel) {
  return picture.rgba[static_cast<std::size_t>(4 * pixel) + 3] >= 0.9999F;
}

//! Returns the mean luminance of those fully covered pixels that are not dark; 1 without such
//! pixels.
double mean_of(const Picture& picture, const std::vector<std::int64_t>& pixels) {
  double sum = 0.0;
  double count = 0.0;
  for (const std::int64_t pixel : pixels) {
    const double light = is_whole(picture, pixel) ? luminance(picture, pixel) : 0.0;
    sum += light;
    count += light > 0.0 ? 1.0 : 0.0;
  }
  return count > 0.0 && sum > 0.0 ? sum / count : 1.0;
}

//! Returns the difference between each pixel's luminance and the exact one, relative to mean_of()
//! the exact picture. NaN for pixels that are not fully covered in both pictures, or dark in both.
std::vector<double> differences(const Picture& picture, const Picture& exact, const std::vector<std::int64_t>& pixels) {
  const double scale = 1.0 / mean_of(exact, pixels);
  std::vector<double> values;
  values.reserve(pixels.size());
  for (const std::int64_t pixel : pixels) {
    const double right = luminance(exact, pixel);
    const double drawn = luminance(picture, pixel);
    const bool compared = is_whole(exact, pixel) && is_whole(picture, pixel) && (right > 0.0 || drawn > 0.0);
    values.push_back(compared ? scale * (drawn - right) : std::numeric_limits<double>::quiet_NaN());
  }
  return values;
}

class PictureRace {
 public:
  PictureRace(const std::vector<PictureChoice>& choices, const AccuracySettings& settings,
              const AccuracyProgress& progress)
      : choices_(choices),
        settings_(settings),
        progress_(progress),
        errors_(choices.size()),
        flickers_(choices.size()) {
    for (const PictureChoice& choice : choices) {
      report_progress(progress, "loading the sky for " + choice.method);
      const Stopwatch watch;
      renderers_.push_back(std::make_unique<ShowRenderer>(choice.show, Backend::cpu, choice.lens));
      Measurement result;
      result.method = choice.method;
      result.setting = choice.setting;
      result.published = choice.published;
      results_.push_back(std::move(result));
    }
  }

  void run(const AccuracyMoment& moment, const ReferencePicture& reference) {
    const PixelLattice lattice = pixel_lattice(moment.projection, settings_.lattice, settings_.seed);
    report_progress(progress_, "the reference picture");
    const Picture now = reference(moment, moment.pose);
    const Picture next = reference(moment, moment.next_pose);
    for (std::size_t i = 0; i < choices_.size(); ++i) {
      report_progress(progress_, choices_[i].method + ", " + choices_[i].setting);
      renderers_[i]->apply(moment.time_s);
      const std::vector<double> later = differences(draw(i, moment, moment.next_pose), next, lattice.pixels);
      const std::vector<double> first = differences(draw(i, moment, moment.pose), now, lattice.pixels);
      read_errors(i, first, later, lattice);
    }
    for (int round = 0; round < settings_.rounds; ++round) {
      for (std::size_t i = 0; i < choices_.size(); ++i) {
        time(i, moment, static_cast<std::size_t>(round));
      }
    }
    first_moment_ = false;
  }

  std::vector<Measurement> results(std::size_t moments) {
    for (std::size_t i = 0; i < choices_.size(); ++i) {
      results_[i].error = summary_of(std::move(errors_[i]));
      results_[i].flicker = summary_of(std::move(flickers_[i])).p99;
      for (double& time_ms : results_[i].frame_ms) {
        time_ms /= static_cast<double>(moments);
      }
    }
    return std::move(results_);
  }

 private:
  Picture draw(std::size_t i, const AccuracyMoment& moment, const CameraPose& pose) {
    return renderers_[i]->render_eye(pose, 0.0, moment.projection, ViewMode::sky, {moment.time_s});
  }

  void read_errors(std::size_t i, const std::vector<double>& first, const std::vector<double>& later,
                   const PixelLattice& lattice) {
    ErrorMap map = {lattice.columns, lattice.rows, {}};
    map.error.reserve(first.size());
    for (std::size_t k = 0; k < first.size(); ++k) {
      map.error.push_back(static_cast<float>(std::abs(first[k])));
      if (!std::isnan(first[k])) {
        errors_[i].push_back(std::abs(first[k]));
      }
      if (!std::isnan(first[k]) && !std::isnan(later[k])) {
        flickers_[i].push_back(std::abs(later[k] - first[k]));
      }
    }
    if (first_moment_) {
      results_[i].map = std::move(map);
    }
  }

  void time(std::size_t i, const AccuracyMoment& moment, std::size_t round) {
    report_progress(progress_, choices_[i].method + ", " + choices_[i].setting);
    const auto before = work_done();
    const Stopwatch watch;
    draw(i, moment, moment.pose);
    const double time_ms = watch.elapsed_ms();
    Measurement& result = results_[i];
    result.frame_ms.resize(std::max(result.frame_ms.size(), round + 1));
    result.frame_ms[round] += time_ms;
    result.passes_ms.clear();
    for (const auto& [name, count] : work_between(before, work_done())) {
      if (count.time_ns > 0) {
        result.passes_ms[name] = 1e-6 * static_cast<double>(count.time_ns);
      }
    }
  }

  const std::vector<PictureChoice>& choices_;
  const AccuracySettings& settings_;
  const AccuracyProgress& progress_;
  std::vector<std::unique_ptr<ShowRenderer>> renderers_;
  std::vector<std::vector<double>> errors_;
  std::vector<std::vector<double>> flickers_;
  std::vector<Measurement> results_;
  bool first_moment_ = true;
};

}  // namespace

std::vector<Measurement> measure_pictures(const std::vector<PictureChoice>& choices, const ReferencePicture& reference,
                                          const std::vector<AccuracyMoment>& moments, const AccuracySettings& settings,
                                          const AccuracyProgress& progress) {
  PictureRace race(choices, settings, progress);
  for (const AccuracyMoment& moment : moments) {
    race.run(moment, reference);
  }
  return race.results(std::max<std::size_t>(moments.size(), 1));
}

Picture averaged(const Picture& picture, int blocks) {
  Picture mean;
  mean.width = picture.width / blocks;
  mean.height = picture.height / blocks;
  mean.rgba.resize(4 * static_cast<std::size_t>(mean.width) * static_cast<std::size_t>(mean.height));
  const double share = 1.0 / (static_cast<double>(blocks) * blocks);
  for (int y = 0; y < mean.height; ++y) {
    for (int x = 0; x < mean.width; ++x) {
      double sum[4] = {0.0, 0.0, 0.0, 0.0};
      for (int part = 0; part < blocks * blocks; ++part) {
        const auto row =
            static_cast<std::size_t>(y) * static_cast<std::size_t>(blocks) + static_cast<std::size_t>(part / blocks);
        const auto column =
            static_cast<std::size_t>(x) * static_cast<std::size_t>(blocks) + static_cast<std::size_t>(part % blocks);
        const float* const light = picture.rgba.data() + 4 * (row * static_cast<std::size_t>(picture.width) + column);
        for (int k = 0; k < 4; ++k) {
          sum[k] += static_cast<double>(light[k]);
        }
      }
      float* const to = mean.rgba.data() + 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(mean.width) +
                                                static_cast<std::size_t>(x));
      for (int k = 0; k < 4; ++k) {
        to[k] = static_cast<float>(share * sum[k]);
      }
    }
  }
  return mean;
}

AccuracySettings no_wider(AccuracySettings settings, const Show& show, int max_px) {
  const int size_px = settings.size_px > 0 ? settings.size_px : std::min(show.view.size_px, settings.max_px);
  settings.size_px = std::min(size_px, max_px);
  return settings;
}

AccuracySettings paced(const AccuracySettings& settings, const Show& show) {
  constexpr int max_slow_px = 384;
  if (!draws_slowly(show)) {
    return settings;
  }
  AccuracySettings slow = no_wider(settings, show, max_slow_px);
  slow.moments = 1;
  slow.rounds = std::min(slow.rounds, 2);
  return slow;
}

}  // namespace ergodome
