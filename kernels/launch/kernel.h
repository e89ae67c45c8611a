#pragma once

// The declarations that each kernel's header makes. They are all that launch()
// (kernels/launch/launch.h) needs.
namespace ergodome {

//! Where kernels run.
enum class Backend { cpu, cuda };

//! The size of a block of whole rows of pixels.
struct PixelRows {
  int width_px;
  int count;
};

//! Default declarations of a kernel.
struct KernelDefaults {
  //! Number type of one lane.
  using Real = float;
  //! The CPU kernel computes with registers of several lanes (WidePack<Real>), not with Real. A
  //! call then computes one element per lane.
  static constexpr bool wide = true;
  //! A call of the CPU kernel computes one element, such as a tile, whatever the number of lanes.
  static constexpr bool one_element_a_call = false;
  //! Number of calls that a CPU thread takes at a time: tens of microseconds of work, so that
  //! uneven rays balance.
  static constexpr int grain = 32;
  //! Launches are counted by work_counter().
  static constexpr bool counted = true;
  //! Number of launches that work_counter() adds for one launch, such as 2 if it serves both eyes.
  static constexpr int counted_launches = 1;
  //! The CPU kernel is compiled once, not for each instruction set.
  static constexpr bool compiled_once = false;

  //! Calls visit(channel, values, count) for each output that must be finite. Values may be null.
  template <class Batch, class Visit>
  static void visit_outputs(const Batch& /*batch*/, const Visit& /*visit*/) {}
};

//! Grain of kernels that trace the rays of a grid. A grid has only hundreds of rays, and each takes
//! longer than a pixel of a picture.
inline constexpr int grid_grain = 4;

//! Declares the kernel that runs a batch. Each batch has a specialization in its header, derived
//! from KernelDefaults, with
//!
//!     static const char* name(const Batch&);      of the counter; nullptr if there is nothing to do
//!     static int elements(const Batch&);          or: static PixelRows rows(const Batch&);
//!     static long work(const Batch&);             counted elements, if they are not elements()
//!
//! The kernel itself is in another header (NAME_kernel.h), for the sources that register kernels
//! (kernels/launch/register.h). It defines dispatch<T>(batch, action), which calls action(functor)
//! for the variant that the batch needs. functor(index) computes the elements of one T, which is
//! WidePack<Real> on the CPU (Real if not `wide`) and Real on a GPU.
template <class Batch>
struct Kernel;

//! Returns the number of elements of a batch.
template <class Batch>
int element_count(const Batch& batch) {
  if constexpr (requires { Kernel<Batch>::rows(batch); }) {
    const PixelRows rows = Kernel<Batch>::rows(batch);
    return rows.width_px * rows.count;
  } else {
    return Kernel<Batch>::elements(batch);
  }
}

//! Returns the number of elements by which a launch of a batch is counted.
template <class Batch>
long counted_elements(const Batch& batch) {
  if constexpr (requires { Kernel<Batch>::work(batch); }) {
    return Kernel<Batch>::work(batch);
  } else {
    return element_count(batch);
  }
}

//! A kernel as compiled for one instruction set.
template <class Batch>
struct CpuKernel {
  void (*run)(const Batch& batch, int begin, int end);  //!< runs calls [begin, end)
  int lanes;                                            //!< number of elements that a call computes

  //! Returns the number of calls that a batch needs.
  [[nodiscard]] int calls(const Batch& batch) const {
    const int elements = element_count(batch);
    return elements > 0 ? (elements - 1) / lanes + 1 : 0;
  }
};

}  // namespace ergodome
