#pragma once

#include <cstddef>
#include <vector>

namespace ergodome {

//! An aperture and how large its pattern is drawn.
struct ApertureSettings {
  //! Sides of the polygon, one level at the top; 0: round. An even count makes as many spikes, an odd one twice.
  int blades = 6;
  //! Arms that hold a secondary mirror, the first one upwards; each makes a line of light across it.
  int vanes = 0;
  double obstruction = 0.0;  //!< radius of the secondary mirror, as part of the aperture's; 0 to 0.9
  int size_px = 129;         //!< width of the pattern; odd, 3 to 1025
  double scale = 1.0;        //!< radius of a round aperture's first dark ring at 550 nm in units of 2 px; 0.25 to 8
};

//! The light of a distant point behind an aperture (Fraunhofer diffraction: the squared Fourier transform of the mask), as the sum of all
//! light left of and above a place: that of any pixel at any wavelength is four reads (Crow, "Summed-area tables for texture mapping",
//! SIGGRAPH 1984).
class FarField {
 public:
  //! Throws Error for settings out of range.
  explicit FarField(const ApertureSettings& settings);

  //! Part of the light of a wavelength that falls left of x_px and above y_px, counted from the middle, y downwards; 1 for all of it.
  [[nodiscard]] double light_before(double x_px, double y_px, double wavelength_nm) const;

 private:
  [[nodiscard]] std::size_t offset(int i, int j) const {
    return static_cast<std::size_t>(j) * static_cast<std::size_t>(cells_ + 1) + static_cast<std::size_t>(i);
  }
  //! The aperture's amplitude transmission, in the first corner of cells_ x cells_ numbers that are 0.
  void draw_mask(const ApertureSettings& settings, float* cells) const;
  //! Sums up the light of amplitudes (real, imaginary; frequency 0 first), from the lowest frequency on, to a total of 1.
  void integrate(const float* amplitudes);

  int diameter_;                //!< of the aperture [cells]
  int cells_;                   //!< to one side of the transform
  double cells_per_px_;         //!< at the reference wavelength
  std::vector<double> before_;  //!< (cells_ + 1)² corners
};

}  // namespace ergodome
