#include "kernels/core/error.h"
#include "render/present/cuda_interop.h"

namespace ergodome {

namespace {

[[noreturn]] void refuse() { throw Error("CUDA", "this program was built without CUDA", "run with --backend cpu"); }

}  // namespace

CudaTextureLink::CudaTextureLink(unsigned) { refuse(); }

CudaTextureLink::~CudaTextureLink() = default;

void CudaTextureLink::copy_from_device(std::span<const Part>) {}

CudaBufferLink::CudaBufferLink(unsigned) { refuse(); }

CudaBufferLink::~CudaBufferLink() = default;

void CudaBufferLink::copy_from_device(const std::uint8_t*, std::size_t) {}

}  // namespace ergodome
