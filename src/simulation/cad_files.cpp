#include <APIHeaderSection_MakeHeader.hxx>
#include <IGESControl_Reader.hxx>
#include <Interface_CheckIterator.hxx>
#include <Interface_InterfaceModel.hxx>
#include <Interface_Static.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <STEPControl_Reader.hxx>
#include <STEPControl_Writer.hxx>
#include <Standard_Failure.hxx>
#include <StepBasic_Product.hxx>
#include <StepData_Protocol.hxx>
#include <StepData_StepModel.hxx>
#include <StepData_StepWriter.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TopExp_Explorer.hxx>
#include <XSControl_WorkSession.hxx>
#include <mutex>
#include <sstream>

#include "base/file.hpp"
#include "simulation/cad_solid.hpp"

namespace probewright::simulation {
namespace {

/// OpenCASCADE's data exchange keeps its settings and messages in global variables: one at a time, and quietly.
std::unique_lock<std::mutex> exchange() {
  static std::mutex mutex;
  std::unique_lock lock(mutex);
  Message::DefaultMessenger()->ChangePrinters().Clear();
  return lock;
}

/// The first complaint the reader has about the file, with its line where the reader tells one.
tl::unexpected<Diagnostic> complaint(const XSControl_Reader& reader, const std::string& file, const char* kind,
                                     const char* advice) {
  std::string reason;
  const Handle(Interface_InterfaceModel) model = reader.WS()->Model();
  if (!model.IsNull()) {
    Interface_CheckIterator checks = reader.WS()->ModelCheckList();
    for (checks.Start(); checks.More() && reason.empty(); checks.Next()) {
      if (checks.Value()->NbFails() > 0) reason = checks.Value()->CFail(1);
    }
  }
  return fail({file, 0, 0}, std::string("the ") + kind + " file cannot be read" + (reason.empty() ? "" : ": " + reason),
              advice);
}

bool hasFace(const TopoDS_Shape& shape) { return !shape.IsNull() && TopExp_Explorer(shape, TopAbs_FACE).More(); }

template <class Reader>
Result<std::unique_ptr<Solid>> transfer(Reader& reader, const std::string& file, const CadOptions& options) {
  reader.TransferRoots();
  const TopoDS_Shape shape = reader.NbShapes() > 0 ? reader.OneShape() : TopoDS_Shape();
  if (!hasFace(shape)) {
    return fail({file, 0, 0}, "the file holds no body and no face",
                "export the part as a solid body, not as a drawing, wire frame or empty assembly");
  }
  auto solid = cadSolid(shape, options);
  if (!solid) solid.error().place.file = file;
  return solid;
}

template <class Read>
Result<std::unique_ptr<Solid>> guarded(const std::string& file, const char* kind, const Read& read) {
  const auto lock = exchange();
  const std::string message = std::string("the ") + kind + " file cannot be read";
  try {
    return read();
  } catch (const Standard_Failure& failure) {
    return fail({file, 0, 0}, message + ": " + failure.GetMessageString(), "export the part again");
  } catch (const std::exception& failure) {
    return fail({file, 0, 0}, message + ": " + failure.what(), "export the part again");
  }
}

}  // namespace

Result<std::unique_ptr<Solid>> readStep(const std::filesystem::path& path, const CadOptions& options) {
  Result<std::string> bytes = readFile(path);
  if (!bytes) return tl::unexpected(bytes.error());
  const std::string file = path.string();
  const std::size_t start = bytes->find_first_not_of(" \t\r\n\xEF\xBB\xBF");
  if (start == std::string::npos) return fail({file, 0, 0}, "the STEP file is empty", "export the part again");
  if (bytes->compare(start, 12, "ISO-10303-21") != 0) {
    return fail({file, 1, 1}, "not a STEP file: it does not begin with ISO-10303-21",
                "export the part as STEP (AP203, AP214 or AP242), or name an IGES or STL file with its own ending");
  }
  if (bytes->find("END-ISO-10303-21") == std::string::npos) {
    return fail({file, 0, 0}, "the STEP file ends before END-ISO-10303-21",
                "the file was cut short; copy or export it again");
  }
  return guarded(file, "STEP", [&]() -> Result<std::unique_ptr<Solid>> {
    STEPControl_Reader reader;
    Interface_Static::SetCVal("xstep.cascade.unit", "MM");
    std::istringstream stream(std::move(*bytes));
    if (reader.ReadStream(file.c_str(), stream) != IFSelect_RetDone) {
      return complaint(reader, file, "STEP", "export the part again as STEP (AP203, AP214 or AP242)");
    }
    return transfer(reader, file, options);
  });
}

Result<std::unique_ptr<Solid>> readIges(const std::filesystem::path& path, const CadOptions& options) {
  Result<std::string> bytes = readFile(path);
  if (!bytes) return tl::unexpected(bytes.error());
  const std::string file = path.string();
  if (bytes->find_first_not_of(" \t\r\n") == std::string::npos) {
    return fail({file, 0, 0}, "the IGES file is empty", "export the part again");
  }
  // Column 73 of every line names its section; the first line belongs to the start section.
  if (bytes->size() < 80 || (bytes->at(72) != 'S' && bytes->at(72) != 'C')) {
    return fail({file, 1, 73}, "not an IGES file: the first line has no section letter S in column 73",
                "export the part as IGES 5.3, or name a STEP or STL file with its own ending");
  }
  return guarded(file, "IGES", [&]() -> Result<std::unique_ptr<Solid>> {
    IGESControl_Reader reader;
    Interface_Static::SetCVal("xstep.cascade.unit", "MM");
    if (reader.ReadFile(file.c_str()) != IFSelect_RetDone) {
      return complaint(reader, file, "IGES", "export the part again as IGES 5.3 or as STEP");
    }
    return transfer(reader, file, options);
  });
}

Result<void> writeStep(const TopoDS_Shape& shape, const std::filesystem::path& path) {
  const auto lock = exchange();
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
