#pragma once

#include <IFSelect_WorkLibrary.hxx>
#include <string>

namespace probewright::simulation {

/// For the session of a STEPControl_Reader: reads the text of a file, whatever stream it is asked to read, into the
/// same entities as OpenCASCADE's library, without those that only annotations refer to.
Handle(IFSelect_WorkLibrary) quickStepLibrary(const std::string& bytes);

}  // namespace probewright::simulation
