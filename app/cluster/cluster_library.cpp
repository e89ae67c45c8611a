#include "app/cluster/cluster_library.h"

#include <dlfcn.h>

#include "kernels/core/error.h"

namespace ergodome {

namespace {

const ClusterLibrary& load_cluster_library() {
  constexpr const char* file = ERGODOME_CLUSTER_MODULE;
  // The module is never closed: its threads may run until the program ends.
  void* const module = dlopen(file, RTLD_LAZY | RTLD_LOCAL);
  void* const entry = module != nullptr ? dlsym(module, "ergodome_zeromq") : nullptr;
  if (entry == nullptr) {
    const char* const reason = dlerror();
    throw Error(file,
                std::string("cannot be loaded: ") + (reason != nullptr ? reason : "it is not a module of Ergodome"),
                "install the package libzmq5, or run app/setup and build again");
  }
  const ClusterLibrary* const library =
      reinterpret_cast<const ClusterLibrary* (*)(std::uint64_t)>(entry)(cluster_interface);
  if (library == nullptr) {
    throw Error(file, "comes from another build than the program", "build everything again, or reinstall");
  }
  return *library;
}

}  // namespace

const ClusterLibrary& cluster_library() {
  static const ClusterLibrary& library = load_cluster_library();
  return library;
}

}  // namespace ergodome
