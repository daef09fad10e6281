#pragma once
/// The one 3-vector over a number type: double, dual numbers, two lanes side by side, packs of lanes.
///
/// The batch kernels include this header. It therefore includes nothing and holds only templates over the number type:
/// what they instantiate on their packs cannot be linked into code for another instruction set. Always inlined: the
/// compiler takes a few operations on wide types for many.

namespace ninedof {

template <class T>
struct Xyz {
  T x, y, z;
};

template <class T>
[[gnu::always_inline]] inline Xyz<T> operator+(const Xyz<T>& a, const Xyz<T>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class T>
[[gnu::always_inline]] inline Xyz<T> operator-(const Xyz<T>& a, const Xyz<T>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class Factor, class T>
[[gnu::always_inline]] inline Xyz<T> operator*(const Factor& k, const Xyz<T>& v) {
  return {k * v.x, k * v.y, k * v.z};
}
template <class T>
[[gnu::always_inline]] inline T dot(const Xyz<T>& a, const Xyz<T>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class T>
[[gnu::always_inline]] inline Xyz<T> cross(const Xyz<T>& a, const Xyz<T>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

}  // namespace ninedof
