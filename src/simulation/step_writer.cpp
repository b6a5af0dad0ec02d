#include <APIHeaderSection_MakeHeader.hxx>
#include <Interface_InterfaceModel.hxx>
#include <Interface_Static.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <STEPControl_Writer.hxx>
#include <Standard_Failure.hxx>
#include <StepBasic_Product.hxx>
#include <StepData_Protocol.hxx>
#include <StepData_StepModel.hxx>
#include <StepData_StepWriter.hxx>
#include <TCollection_HAsciiString.hxx>
#include <XSControl_WorkSession.hxx>
#include <mutex>
#include <sstream>

#include "base/file.hpp"
#include "simulation/cad_solid.hpp"

namespace probewright::simulation {
Result<void> writeStep(const TopoDS_Shape& shape, const std::filesystem::path& path) {
  // OpenCASCADE's data exchange keeps its settings and messages in global variables: one at a time, and quietly.
  static std::mutex mutex;
  const std::scoped_lock lock(mutex);
  Message::DefaultMessenger()->ChangePrinters().Clear();
  const auto broken = [&](const std::string& reason) {
    return fail({path.string(), 0, 0}, "the part cannot be written as STEP" + reason, "write it as STL instead");
  };
  std::ostringstream stream;
  try {
    STEPControl_Writer writer;
    Interface_Static::SetCVal("write.step.schema", "AP214IS");
    Interface_Static::SetCVal("write.step.unit", "MM");
    if (writer.Transfer(shape, STEPControl_AsIs) != IFSelect_RetDone) return broken("");
    const auto text = [](const char* value) { return new TCollection_HAsciiString(value); };
    // The writer numbers the products of a process; two writings of one part would differ.
    for (int i = 1; i <= writer.Model()->NbEntities(); ++i) {
      if (const auto product = Handle(StepBasic_Product)::DownCast(writer.Model()->Value(i))) {
        product->SetId(text(path.stem().string().c_str()));
        product->SetName(text(path.stem().string().c_str()));
      }
    }
    APIHeaderSection_MakeHeader header(writer.Model());
    header.SetName(text(path.filename().string().c_str()));
    header.SetTimeStamp(text("2000-01-01T00:00:00"));
    header.SetAuthorValue(1, text("Probewright"));
    header.SetOrganizationValue(1, text("Probewright"));
    header.SetOriginatingSystem(text("Probewright"));
    header.Apply(writer.Model());
    StepData_StepWriter printer(writer.Model());
    printer.SendModel(Handle(StepData_Protocol)::DownCast(writer.WS()->Protocol()));
    if (!printer.Print(stream)) return broken("");
  } catch (const Standard_Failure& failure) {
    return broken(std::string(": ") + failure.GetMessageString());
  }
  return writeFileAtomically(path, stream.str());
}

Result<void> writeStep(const Solid& solid, const std::filesystem::path& path) {
  if (const auto* cad = dynamic_cast<const CadSolid*>(&solid)) return writeStep(cad->shape(), path);
  return fail({path.string(), 0, 0}, "a solid of triangles cannot be written as STEP", "write it as STL instead");
}

}  // namespace probewright::simulation
