#pragma once

#include "kernels/core/host_device.h"

// Coefficients of Runge-Kutta pairs. They are functions with a local table, because device code
// cannot read static arrays of the host.
namespace ergodome::inline ERGO_TARGET {

//! The RK 3(4) pair: the classical fourth-order method, and a third-order solution from its first
//! three stages and the derivative at the new point (which is the first stage of the next step).
//!
//! The third-order weights (1, 2, 3) / 6 of the published tracer do not satisfy the order
//! conditions (their first moment is 5/12, not 1/2); only the baseline uses them.
struct RungeKutta34 {
  static constexpr int stages = 5;
  static constexpr int error_order = 3;
  static constexpr bool first_same_as_last = true;
  ERGO_HD static constexpr double a(int i, int j) {
    constexpr double table[5][4] = {
        {0, 0, 0, 0}, {0.5, 0, 0, 0}, {0, 0.5, 0, 0}, {0, 0, 1, 0}, {1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6}};
    return table[i][j];
  }
  ERGO_HD static constexpr double b(int i) {
    constexpr double table[5] = {1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6, 0};
    return table[i];
  }
  ERGO_HD static constexpr double b_embedded(int i) {
    constexpr double table[5] = {1.0 / 6, 1.0 / 3, 1.0 / 3, 0, 1.0 / 6};
    return table[i];
  }
};

//! Cash & Karp, ACM TOMS 16 (1990) 201: order 5 with an embedded solution of order 4.
struct CashKarp {
  static constexpr int stages = 6;
  static constexpr int error_order = 4;
  static constexpr bool first_same_as_last = false;
  ERGO_HD static constexpr double a(int i, int j) {
    constexpr double table[6][5] = {{0, 0, 0, 0, 0},
                                    {1.0 / 5, 0, 0, 0, 0},
                                    {3.0 / 40, 9.0 / 40, 0, 0, 0},
                                    {3.0 / 10, -9.0 / 10, 6.0 / 5, 0, 0},
                                    {-11.0 / 54, 5.0 / 2, -70.0 / 27, 35.0 / 27, 0},
                                    {1631.0 / 55296, 175.0 / 512, 575.0 / 13824, 44275.0 / 110592, 253.0 / 4096}};
    return table[i][j];
  }
  ERGO_HD static constexpr double b(int i) {
    constexpr double table[6] = {37.0 / 378, 0, 250.0 / 621, 125.0 / 594, 0, 512.0 / 1771};
    return table[i];
  }
  ERGO_HD static constexpr double b_embedded(int i) {
    constexpr double table[6] = {2825.0 / 27648, 0, 18575.0 / 48384, 13525.0 / 55296, 277.0 / 14336, 1.0 / 4};
    return table[i];
  }
};

}  // namespace ergodome::inline ERGO_TARGET
