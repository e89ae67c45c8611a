#pragma once

namespace ergodome {

// Conversions of magnitudes and colors of other photometric systems to Johnson's V and B-V. All
// values are in magnitudes; NaN stays NaN.

//! Returns B-V of a star from Gaia's BP-RP, by the mean colors of dwarfs of types B9 to M8 (Pecaut
//! & Mamajek, ApJS 208, 9, 2013; Mamajek's table of 2024.05.15). Clamped to [-0.4, 2.15].
double b_v_from_bp_rp(double bp_rp);

//! Returns B-V of a star from its temperature [K]: the inverse of star_temperature() (Ballesteros,
//! EPL 97, 34008, 2012, eq. 14). NaN below 1000 K.
double b_v_from_temperature(double temperature_k);

//! Returns V from Gaia's G and BP-RP (Riello et al., A&A 649, A3, 2021, table C.2), with BP-RP
//! clamped to [-0.5, 5]. Returns G if BP-RP is NaN.
double v_from_gaia(double g_mag, double bp_rp);

//! Returns V or B-V from Tycho's magnitudes (ESA SP-1200, vol. 1, sect. 1.3). V is VT if BT is NaN.
double v_from_tycho(double bt_mag, double vt_mag);
double b_v_from_tycho(double bt_mag, double vt_mag);

}  // namespace ergodome
