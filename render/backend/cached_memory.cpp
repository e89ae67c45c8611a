#include "render/backend/cached_memory.h"

#include <malloc.h>

#include <algorithm>
#include <cstdlib>
#include <mutex>
#include <vector>

#include "kernels/launch/large_memory.h"

namespace ergodome {

namespace {

constexpr std::size_t page_bytes = std::size_t{1} << 21U;
//! Limits of the cache: enough for the pictures of two eyes and for the buffers in which they are
//! combined.
constexpr std::size_t max_cached_blocks = 4;
constexpr std::size_t max_cached_bytes = std::size_t{3} << 29U;
//! Block size up to which glibc takes memory from its heap, the maximum that it allows (larger
//! blocks are always mapped and unmapped), and the free memory at the heap's end that it keeps
//! instead of returning it to the system.
constexpr int max_heap_bytes = 32 << 20;
constexpr int max_free_bytes = 1 << 30;

struct CachedBlock {
  void* memory;
  std::size_t bytes;
};

std::size_t whole_pages(std::size_t bytes) { return (bytes / page_bytes + 1) * page_bytes; }

//! Blocks that were released and are kept for later requests, the latest last.
class BlockCache {
 public:
  //! Removes a block of exactly that size from the cache and returns it; nullptr if there is none.
  void* take(std::size_t bytes) {
    const std::lock_guard lock(mutex_);
    const auto found = std::ranges::find(blocks_, bytes, &CachedBlock::bytes);
    if (found == blocks_.end()) {
      return nullptr;
    }
    void* const memory = found->memory;
    blocks_.erase(found);
    cached_bytes_ -= bytes;
    return memory;
  }

  void put(const CachedBlock& block) {
    const std::lock_guard lock(mutex_);
    blocks_.push_back(block);
    cached_bytes_ += block.bytes;
    while (blocks_.size() > max_cached_blocks || cached_bytes_ > max_cached_bytes) {
      std::free(blocks_.front().memory);
      cached_bytes_ -= blocks_.front().bytes;
      blocks_.erase(blocks_.begin());
    }
  }

  [[nodiscard]] std::size_t count() {
    const std::lock_guard lock(mutex_);
    return blocks_.size();
  }

 private:
  std::mutex mutex_;
  std::vector<CachedBlock> blocks_;
  std::size_t cached_bytes_ = 0;
};

BlockCache& block_cache() {
  // Never destroyed: memory may be returned to it during program exit.
  static BlockCache& kept = *new BlockCache;
  return kept;
}

}  // namespace

void keep_freed_memory() {
  mallopt(M_MMAP_THRESHOLD, max_heap_bytes);
  mallopt(M_TRIM_THRESHOLD, max_free_bytes);
}

void* take_large_block(std::size_t bytes) {
  if (void* const kept = block_cache().take(whole_pages(bytes))) {
    return kept;
  }
  return allocate_large(bytes);
}

void return_large_block(void* memory, std::size_t bytes) noexcept {
  try {
    block_cache().put({memory, whole_pages(bytes)});
  } catch (...) {
    std::free(memory);
  }
}

std::size_t cached_large_blocks() { return block_cache().count(); }

}  // namespace ergodome

// NOLINTNEXTLINE(bugprone-std-namespace-modification): the standard allows this for a type of one's own
template class std::vector<float, ergodome::UnfilledAllocator<float>>;
