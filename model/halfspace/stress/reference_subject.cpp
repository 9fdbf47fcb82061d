#include "halfspace/stress/reference_subject.hpp"

#include <fmt/format.h>

#include "halfspace/reference/methods.hpp"
#include "halfspace/stress/reference_picture.hpp"

namespace halfspace::stress {
namespace {

class Reference final : public Subject {
 public:
  Reference(const reference::Method& method, int sub_pixel_bits)
      : method_(method), sub_pixel_bits_(sub_pixel_bits) {}

  [[nodiscard]] std::string name() const override { return fmt::format("reference {}", method_.name); }

  Picture draw(const Frame& frame) override { return reference_picture(frame, sub_pixel_bits_, method_); }

 private:
  reference::Method method_;
  int sub_pixel_bits_;
};

}  // namespace

std::unique_ptr<Subject> reference_subject(std::string_view method, int sub_pixel_bits) {
  return std::make_unique<Reference>(reference::method_of(method), sub_pixel_bits);
}

}  // namespace halfspace::stress
