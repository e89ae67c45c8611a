#include "kernels/launch/kernel_table.h"

namespace ergodome {

#if defined(ERGODOME_SIMD_PORTABLE)
inline namespace portable {
const KernelTable& own_kernel_table();
}
#endif
#if defined(ERGODOME_SIMD_AVX2)
namespace avx2 {
const KernelTable& own_kernel_table();
}
#endif
#if defined(ERGODOME_SIMD_AVX512)
namespace avx512 {
const KernelTable& own_kernel_table();
}
#endif

const KernelTable& kernel_table(InstructionSet set) {
  switch (set) {
    case InstructionSet::avx512:
#if defined(ERGODOME_SIMD_AVX512)
      return avx512::own_kernel_table();
#endif
    case InstructionSet::avx2:
#if defined(ERGODOME_SIMD_AVX2)
      return avx2::own_kernel_table();
#endif
    case InstructionSet::portable:
#if defined(ERGODOME_SIMD_PORTABLE)
      return portable::own_kernel_table();
#endif
      break;
  }
  throw missing_instruction_set();
}

}  // namespace ergodome
