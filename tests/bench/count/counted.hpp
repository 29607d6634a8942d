#pragma once

#include <cmath>

namespace plain {

/// A number that counts the operations done with it: sums, products, quotients, roots and powers one each.
/// Comparisons and changes of sign are free.
struct Counted {
  double value;
  static inline long operations = 0;

  Counted(double v = 0) : value(v) {}  // NOLINT: numbers mix with it freely
  explicit operator int() const { return static_cast<int>(value); }

  friend Counted operator+(Counted a, Counted b) { return counted(a.value + b.value); }
  friend Counted operator-(Counted a, Counted b) { return counted(a.value - b.value); }
  friend Counted operator*(Counted a, Counted b) { return counted(a.value * b.value); }
  friend Counted operator/(Counted a, Counted b) { return counted(a.value / b.value); }
  Counted operator-() const { return -value; }
  Counted& operator+=(Counted b) { return *this = *this + b; }
  Counted& operator-=(Counted b) { return *this = *this - b; }
  Counted& operator/=(Counted b) { return *this = *this / b; }
  friend bool operator<(Counted a, Counted b) { return a.value < b.value; }
  friend bool operator>(Counted a, Counted b) { return a.value > b.value; }
  friend Counted sqrt(Counted a) { return counted(std::sqrt(a.value)); }
  friend Counted pow(Counted a, Counted b) { return counted(std::pow(a.value, b.value)); }

 private:
  static Counted counted(double result) {
    ++operations;
    return result;
  }
};

}  // namespace plain
