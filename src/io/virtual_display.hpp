#pragma once
#include <sys/types.h>

#include <chrono>
#include <string>

namespace knap {

/// An Xvfb server of our own on a free display, ended with this object (and with this process, however that ends).
class VirtualDisplay {
 public:
  /// Throws RuntimeFailure if Xvfb is missing or does not come up in time.
  explicit VirtualDisplay(std::chrono::seconds timeout);
  ~VirtualDisplay();
  VirtualDisplay(const VirtualDisplay&) = delete;
  VirtualDisplay& operator=(const VirtualDisplay&) = delete;

  /// The value for $DISPLAY, e.g. ":7".
  const std::string& name() const { return name_; }

 private:
  void stop();

  pid_t server_ = -1;
  std::string name_;
};

}  // namespace knap
