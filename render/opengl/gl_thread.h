#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

namespace ergodome {

//! A dedicated thread with an OpenGL 4.5 context that needs no display. It keeps that context
//! separate from a window's context that the calling thread may have.
class GlThread {
 public:
  //! Throws Error if no driver provides OpenGL 4.5 (HeadlessContext).
  GlThread();
  ~GlThread();
  GlThread(const GlThread&) = delete;
  GlThread& operator=(const GlThread&) = delete;

  //! Runs a function on the thread and waits for it. Rethrows its exceptions.
  void run(const std::function<void()>& work);

 private:
  void serve();

  std::mutex mutex_;
  std::condition_variable changed_;
  const std::function<void()>* work_ = nullptr;  //!< function to run
  bool done_ = false;
  bool ends_ = false;
  std::exception_ptr problem_;
  std::mutex callers_;  //!< held while a caller uses the thread, so that one call runs at a time
  std::thread thread_;
};

}  // namespace ergodome
