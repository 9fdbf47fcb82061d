/// The picture of a ledger, for people.
#pragma once

#include <string>

#include "halfspace/report/ledger_files.hpp"

namespace halfspace {

/// An SVG document: a bar for each account of the frame, divided by causes in the order of the pipeline, with
/// the numbers below it; and, where they were measured, what each switch saves.
std::string ledger_picture(const LedgerReport& report);

}  // namespace halfspace
