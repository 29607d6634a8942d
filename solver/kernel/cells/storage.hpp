#pragma once

#include <sys/mman.h>

#include <cstddef>
#include <cstdint>
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

  T* allocate(std::size_t n) {
    const std::size_t bytes = n * sizeof(T);
    if (bytes < page) return static_cast<T*>(::operator new (bytes, std::align_val_t{alignof(T)}));
    return static_cast<T*>(map(whole_pages(bytes)));
  }
  void deallocate(T* memory, std::size_t n) {
    const std::size_t bytes = n * sizeof(T);
    if (bytes < page) return ::operator delete (memory, std::align_val_t{alignof(T)});
    munmap(memory, whole_pages(bytes));
  }
  friend bool operator==(LargePages, LargePages) { return true; }

 private:
  static std::size_t whole_pages(std::size_t bytes) { return (bytes + page - 1) / page * page; }

  /// Straight from the system: what a heap hands out again is on the small pages that it had before.
  static void* map(std::size_t bytes) {
    void* const mapped =
        mmap(nullptr, bytes + page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (mapped == MAP_FAILED) throw std::bad_alloc();
    char* const begin = static_cast<char*>(mapped);
    const std::size_t before =
        whole_pages(reinterpret_cast<std::uintptr_t>(begin)) - reinterpret_cast<std::uintptr_t>(begin);
    if (before > 0) munmap(begin, before);
    munmap(begin + before + bytes, page - before);
#ifdef MADV_HUGEPAGE
    madvise(begin + before, bytes, MADV_HUGEPAGE);
#endif
    return begin + before;
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
