#pragma once

namespace ergodome {

// Magnitudes and colours of other systems than Johnson's, as B-V and V. All in magnitudes; NaN
// stays NaN.

//! Returns B-V of a star of Gaia's colour BP-RP, by the mean colours of dwarfs of types B9 to M8
//! (Pecaut & Mamajek, ApJS 208, 9, 2013; Mamajek's table of 2024.05.15). Clamped to B-V between
//! -0.4 and 2.15.
double b_v_from_bp_rp(double bp_rp);

//! Returns B-V of a star of temperature [K]: the inverse of star_temperature() (Ballesteros, EPL
//! 97, 34008, 2012, eq. 14). NaN below 1000 K.
double b_v_from_temperature(double temperature_k);

//! Returns V of Gaia's G and BP-RP (Riello et al., A&A 649, A3, 2021, table C.2; -0.5 < BP-RP < 5).
//! G where BP-RP is NaN.
double v_from_gaia(double g_mag, double bp_rp);

//! Returns V and B-V of Tycho's magnitudes (ESA SP-1200, vol. 1, sect. 1.3). V is VT where BT is
//! NaN.
double v_from_tycho(double bt_mag, double vt_mag);
double b_v_from_tycho(double bt_mag, double vt_mag);

}  // namespace ergodome
