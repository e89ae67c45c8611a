#pragma once

#include "kernels/core/host_device.h"

namespace ergodome {

//! Three components of any arithmetic type: a number, a SIMD pack of numbers, or a dual number.
template <class T>
struct Vector3 {
  T x, y, z;
};

inline namespace ERGO_TARGET {

template <class T>
ERGO_HD Vector3<T> operator+(const Vector3<T>& a, const Vector3<T>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}

template <class T>
ERGO_HD Vector3<T> operator-(const Vector3<T>& a, const Vector3<T>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}

template <class T>
ERGO_HD Vector3<T> operator-(const Vector3<T>& a) {
  return {-a.x, -a.y, -a.z};
}

template <class T, class S>
ERGO_HD Vector3<T> operator*(const S& s, const Vector3<T>& a) {
  return {s * a.x, s * a.y, s * a.z};
}

template <class T>
ERGO_HD T dot(const Vector3<T>& a, const Vector3<T>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

template <class T>
ERGO_HD Vector3<T> cross(const Vector3<T>& a, const Vector3<T>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

}  // namespace ERGO_TARGET
}  // namespace ergodome
