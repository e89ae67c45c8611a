#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

namespace ergodome {

//! A thread of its own with an OpenGL 4.5 context that needs no display. Pictures are rendered on whatever thread asks for them, which may
//! have a window's context: neither gets into the other's way.
class GlThread {
 public:
  //! Throws Error when no driver gives OpenGL 4.5 (HeadlessContext).
  GlThread();
  ~GlThread();
  GlThread(const GlThread&) = delete;
  GlThread& operator=(const GlThread&) = delete;

  //! Does a piece of work there and waits for it. Throws what it throws.
  void run(const std::function<void()>& work);

 private:
  void serve();

  std::mutex mutex_;
  std::condition_variable changed_;
  const std::function<void()>* work_ = nullptr;  //!< what is to be done
  bool done_ = false;
  bool ends_ = false;
  std::exception_ptr problem_;
  std::mutex callers_;  //!< one at a time
  std::thread thread_;
};

}  // namespace ergodome
