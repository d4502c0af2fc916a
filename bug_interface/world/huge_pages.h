// Memory for large tables that are read here and there.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <new>

#include <sys/mman.h>

namespace forage::bug {

/// An allocator that asks the system for large pages: far fewer of them to be made, and to be looked up.
/// Where there are none it is an ordinary one.
template <class T>
class HugePages {
  public:
    using value_type = T;
    HugePages() = default;
    template <class U>
    HugePages(const HugePages<U>&) {}

    T* allocate(std::size_t count) {
        const std::size_t size = count * sizeof(T);
        if (size < page) return static_cast<T*>(::operator new(size));
        void* memory = std::aligned_alloc(page, (size + page - 1) / page * page);
        if (!memory) throw std::bad_alloc();
        madvise(memory, size, MADV_HUGEPAGE);
        return static_cast<T*>(memory);
    }
    void deallocate(T* memory, std::size_t count) {
        if (count * sizeof(T) < page)
            ::operator delete(memory);
        else
            std::free(memory);
    }
    bool operator==(const HugePages&) const = default;

  private:
    static constexpr std::size_t page = 2u << 20;  ///< bytes
};

}  // namespace forage::bug
