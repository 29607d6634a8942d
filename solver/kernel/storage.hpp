#pragma once

#include <sys/mman.h>

#include <cstddef>
#include <new>
#include <vector>

namespace mpm::MPM_ISA {

/// Memory for long arrays that are read from end to end every step: on large pages where the system has them,
/// which a processor finds much faster.
template <class T>
struct LargePages {
  using value_type = T;
  static constexpr std::size_t page = std::size_t{1} << 21;

  LargePages() = default;
  template <class U>
  LargePages(const LargePages<U>&) {}

  static std::align_val_t alignment(std::size_t n) {
    return std::align_val_t{n * sizeof(T) < page ? alignof(T) : page};
  }
  T* allocate(std::size_t n) {
    void* memory = ::operator new(n * sizeof(T), alignment(n));
#ifdef MADV_HUGEPAGE
    if (n * sizeof(T) >= page) madvise(memory, n * sizeof(T), MADV_HUGEPAGE);
#endif
    return static_cast<T*>(memory);
  }
  void deallocate(T* memory, std::size_t n) {
    ::operator delete(memory, alignment(n));
  }
  friend bool operator==(LargePages, LargePages) {
    return true;
  }
};

template <class T>
using LargeArray = std::vector<T, LargePages<T>>;

/// Brings a cache line into the second cache. It can wait for more lines at a time than the first, and so
/// takes more from memory in addresses that the hardware does not foresee.
[[gnu::always_inline]] inline void fetch_ahead(const void* address) {
  __builtin_prefetch(address, 0, 2);
}

}  // namespace mpm::MPM_ISA
