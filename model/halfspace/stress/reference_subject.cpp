#include "halfspace/stress/reference_subject.hpp"

#include <fmt/format.h>

#include "halfspace/reference/methods.hpp"
#include "halfspace/stress/reference_picture.hpp"

namespace halfspace::stress {
namespace {

class Reference final : public Subject {
 public:
  Reference(const reference::Method& method, const Precision& precision)
      : method_(method), precision_(precision) {}

  [[nodiscard]] std::string name() const override { return fmt::format("reference {}", method_.name); }

  Picture draw(const Frame& frame) override { return reference_picture(frame, precision_, method_); }

 private:
  reference::Method method_;
  Precision precision_;
};

}  // namespace

std::unique_ptr<Subject> reference_subject(std::string_view method, const Precision& precision) {
  return std::make_unique<Reference>(reference::method_of(method), precision);
}

}  // namespace halfspace::stress
