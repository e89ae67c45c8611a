#pragma once

#include <cstddef>
#include <vector>

namespace ergodome {

//! The shape of an aperture, and the size of its diffraction pattern.
struct ApertureSettings {
  //! Number of sides of the polygonal aperture, with a horizontal side at the top; 0: round. An
  //! even number of sides makes as many spikes, an odd number twice as many.
  int blades = 6;
  //! Number of arms that hold a secondary mirror, the first one upwards; each makes a line of light
  //! perpendicular to itself.
  int vanes = 0;
  double obstruction = 0.0;  //!< radius of the secondary mirror as a fraction of the aperture's; 0 to 0.9
  int size_px = 129;         //!< width of the pattern; odd, 3 to 1025
  double scale = 1.0;        //!< radius of a round aperture's first dark ring at 550 nm, in units of 2 px; 0.25 to 8
};

//! The light of a distant point behind an aperture (Fraunhofer diffraction: the squared Fourier
//! transform of the mask), stored as a summed-area table. The light of any pixel at any wavelength
//! takes four reads (Crow, "Summed-area tables for texture mapping", SIGGRAPH 1984).
class FarField {
 public:
  //! Throws Error for settings out of range.
  explicit FarField(const ApertureSettings& settings);

  //! Returns the fraction of the light of a wavelength that falls to the left of x_px and above
  //! y_px. Coordinates are measured from the center of the pattern, y downwards.
  [[nodiscard]] double light_before(double x_px, double y_px, double wavelength_nm) const;

 private:
  [[nodiscard]] std::size_t offset(int i, int j) const {
    return static_cast<std::size_t>(j) * static_cast<std::size_t>(cells_ + 1) + static_cast<std::size_t>(i);
  }
  //! Draws the aperture's transmission into a corner of cells_ x cells_ zeros.
  void draw_mask(const ApertureSettings& settings, float* cells) const;
  //! Computes the summed-area table from the Fourier transform's amplitudes (real and imaginary
  //! part, frequency 0 first), and normalizes the total light to 1.
  void integrate(const float* amplitudes);

  int diameter_;                //!< diameter of the aperture [cells]
  int cells_;                   //!< number of cells per side of the Fourier transform
  double cells_per_px_;         //!< cells of the transform per pixel, at the reference wavelength
  std::vector<double> before_;  //!< summed-area table: light before each of (cells_ + 1)² corners
};

}  // namespace ergodome
