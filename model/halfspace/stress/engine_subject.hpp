/// An engine of this library as what the stress campaign draws with.
#pragma once

#include <memory>

#include "halfspace/config/config.hpp"
#include "halfspace/run/run.hpp"
#include "halfspace/stress/subject.hpp"

namespace halfspace::stress {

/// A machine in a fidelity. `options.watch` is the subject's own but for the core. On the readable core,
/// which is the units, it tells the walker's decisions too.
std::unique_ptr<Subject> engine_subject(Fidelity fidelity, const Config& config, RunOptions options);

}  // namespace halfspace::stress
