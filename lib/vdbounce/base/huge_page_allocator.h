// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdlib>
#include <new>
#include <utility>

#include <sys/mman.h>

namespace vdbounce {

/// An allocator for large arrays that are read in random order: asks for pages of 2 MiB, so that fewer addresses have
/// to be translated (4 % of a lookup's time). Where the system has none to give, ordinary pages do.
template <class T> struct HugePageAllocator {
    using value_type = T;

    HugePageAllocator() = default;
    template <class Other> HugePageAllocator(const HugePageAllocator<Other>&) {}

    T* allocate(std::size_t count)
    {
        constexpr std::size_t kPage = std::size_t(1) << 21;
        constexpr std::size_t kLine = 64;
        const std::size_t alignment = count * sizeof(T) >= kPage ? kPage : kLine;
        const std::size_t bytes = (count * sizeof(T) + alignment - 1) / alignment * alignment;
        void* memory = std::aligned_alloc(alignment, bytes);
        if (memory == nullptr) throw std::bad_alloc();
        if (alignment == kPage) madvise(memory, bytes, MADV_HUGEPAGE);
        return static_cast<T*>(memory);
    }
    void deallocate(T* memory, std::size_t) { std::free(memory); }

    /// Elements without a value are left as they are: arrays are filled by many threads, zeros first would be by one.
    template <class Element> void construct(Element* place) { ::new (static_cast<void*>(place)) Element; }
    template <class Element, class... Arguments> void construct(Element* place, Arguments&&... arguments)
    {
        ::new (static_cast<void*>(place)) Element(std::forward<Arguments>(arguments)...);
    }

    friend bool operator==(const HugePageAllocator&, const HugePageAllocator&) { return true; }
    friend bool operator!=(const HugePageAllocator&, const HugePageAllocator&) { return false; }
};

} // namespace vdbounce
