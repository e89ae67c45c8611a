#pragma once

namespace ergodome {

//! While an object exists, launches and parallel_for() on its thread use only that thread. Work in
//! the background thus leaves the others to pictures.
class BackgroundWork {
 public:
  BackgroundWork();
  ~BackgroundWork();
  BackgroundWork(const BackgroundWork&) = delete;
  BackgroundWork& operator=(const BackgroundWork&) = delete;
};

}  // namespace ergodome
