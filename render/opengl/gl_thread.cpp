#include "render/opengl/gl_thread.h"

#include <optional>

#include "kernels/core/error.h"
#include "kernels/launch/work_counter.h"
#include "render/opengl/headless_context.h"

namespace ergodome {

GlThread::GlThread() : thread_([this] { serve(); }) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return done_; });
  done_ = false;
  if (problem_) {
    lock.unlock();
    thread_.join();
    std::rethrow_exception(problem_);
  }
}

GlThread::~GlThread() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  changed_.notify_all();
  if (thread_.joinable()) {
    thread_.join();
  }
}

void GlThread::run(const std::function<void()>& work) {
  const std::lock_guard alone(callers_);
  std::unique_lock lock(mutex_);
  work_ = &work;
  problem_ = nullptr;
  changed_.notify_all();
  changed_.wait(lock, [this] { return done_; });
  done_ = false;
  if (problem_) {
    std::rethrow_exception(problem_);
  }
}

void GlThread::serve() {
  static WorkCounter counter("open_gl");
  std::optional<HeadlessContext> context;
  std::unique_lock lock(mutex_);
  try {
    const WorkScope scope(counter, 1);
    context.emplace();
  } catch (const Error&) {
    problem_ = std::current_exception();
  }
  done_ = true;
  changed_.notify_all();
  while (context) {
    changed_.wait(lock, [this] { return ends_ || work_ != nullptr; });
    if (ends_) {
      return;
    }
    lock.unlock();
    std::exception_ptr problem;
    try {
      (*work_)();
    } catch (...) {
      problem = std::current_exception();
    }
    lock.lock();
    problem_ = problem;
    work_ = nullptr;
    done_ = true;
    changed_.notify_all();
  }
}

}  // namespace ergodome
