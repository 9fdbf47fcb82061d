/// A progress bar on stderr, for work of more than a second, and only on a terminal.
#pragma once

#include <unistd.h>

#include <chrono>
#include <cstddef>
#include <cstdio>
#include <string>

namespace halfspace {

class ProgressBar {
 public:
  explicit ProgressBar(std::string label) : label_(std::move(label)) {}
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;
  ~ProgressBar() {
    if (shown_) {
      std::fprintf(stderr, "\r\033[K");
    }
  }

  void update(std::size_t done, std::size_t of) {
    const auto now = std::chrono::steady_clock::now();
    if (!terminal_ || now < next_ || of == 0) {
      return;
    }
    next_ = now + std::chrono::milliseconds(100);
    shown_ = true;
    const std::string bar(done * kWidth / of, '#');
    std::fprintf(stderr, "\r%s [%-*s] %zu/%zu", label_.c_str(), kWidth, bar.c_str(), done, of);
  }

 private:
  static constexpr int kWidth = 40;

  std::string label_;
  bool terminal_ = isatty(STDERR_FILENO) == 1;
  bool shown_ = false;
  std::chrono::steady_clock::time_point next_ = std::chrono::steady_clock::now() + std::chrono::seconds(1);
};

}  // namespace halfspace
