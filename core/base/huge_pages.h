// Memory for large tables.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <new>
#include <vector>

#include <sys/mman.h>

namespace forage {

/// An allocator that requests large pages for large blocks, which cause fewer page faults and address
/// look-ups. On systems without large pages it is an ordinary allocator. Blocks are aligned to cache lines.
template <class T>
class HugePages {
  public:
    using value_type = T;
    HugePages() = default;
    template <class U>
    HugePages(const HugePages<U>&) {}

    T* allocate(std::size_t count) {
        const std::size_t size = count * sizeof(T), whole = (size + page - 1) / page * page;
        if (size < large) return static_cast<T*>(::operator new(size, line));
        void* memory = std::aligned_alloc(page, whole);
        if (!memory) throw std::bad_alloc();
#ifdef MADV_HUGEPAGE
        madvise(memory, whole, MADV_HUGEPAGE);
#endif
        return static_cast<T*>(memory);
    }
    void deallocate(T* memory, std::size_t count) {
        if (count * sizeof(T) < large)
            ::operator delete(memory, line);
        else
            std::free(memory);
    }
    bool operator==(const HugePages&) const = default;

  private:
    static constexpr std::size_t page = std::size_t{2} << 20, large = page / 4;  ///< bytes
    static constexpr std::align_val_t line{64};
};

template <class T>
using HugeVector = std::vector<T, HugePages<T>>;

}  // namespace forage
