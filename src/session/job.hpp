#pragma once

#include <filesystem>

#include "conversion/job.hpp"
#include "session/source.hpp"

namespace probewright::session {

/// Looks through the folder of a program for those that call each other with it, directly or through others.
conversion::Job jobOf(const std::filesystem::path& path, ProgramLanguage language);

}  // namespace probewright::session
