#include "simulation/cad_step_library.hpp"

#include <Interface_ParamType.hxx>
#include <Interface_Protocol.hxx>
#include <StepData_FileRecognizer.hxx>
#include <StepData_Protocol.hxx>
#include <StepData_StepModel.hxx>
#include <StepData_StepReaderData.hxx>
#include <StepData_StepReaderTool.hxx>
#include <StepSelect_WorkLibrary.hxx>
#include <sstream>

#include "simulation/step_records.hpp"
#include "simulation/step_text.hpp"

namespace probewright::simulation {
namespace {

Interface_ParamType typeOf(StepRecords::Kind kind) {
  switch (kind) {
    case StepRecords::Kind::Integer:
      return Interface_ParamInteger;
    case StepRecords::Kind::Real:
      return Interface_ParamReal;
    case StepRecords::Kind::Reference:
      return Interface_ParamIdent;
    case StepRecords::Kind::Enumeration:
      return Interface_ParamEnum;
    case StepRecords::Kind::Text:
      return Interface_ParamText;
    case StepRecords::Kind::Binary:
      return Interface_ParamHexa;
    case StepRecords::Kind::Nothing:
      return Interface_ParamVoid;
    case StepRecords::Kind::Derived:
      return Interface_ParamMisc;
    case StepRecords::Kind::List:
      return Interface_ParamSub;
  }
  return Interface_ParamMisc;
}

class QuickLibrary : public StepSelect_WorkLibrary {
public:
  explicit QuickLibrary(const std::string& bytes) : bytes_(bytes) {}

  Standard_Integer ReadStream(const Standard_CString name, std::istream&, Handle(Interface_InterfaceModel) & model,
                              const Handle(Interface_Protocol) & protocol) const override {
    const auto step = Handle(StepData_Protocol)::DownCast(protocol);
    std::optional<StepRecords> records = step.IsNull() ? std::nullopt : StepRecords::of(bytes_);
    if (!records) {
      std::istringstream stream(withCapitalExponents(bytes_));
      return StepSelect_WorkLibrary::ReadStream(name, stream, model, protocol);
    }
    records->joinShapes();
    records->dropAnnotations();
    const Handle(StepData_StepModel) made = new StepData_StepModel;
    load(*records, made, step);
    model = made;
    return 0;
  }

private:
  static void load(const StepRecords& records, const Handle(StepData_StepModel) & model,
                   const Handle(StepData_Protocol) & protocol) {
    std::size_t parameters = 0;
    for (const StepRecords::Record& record : records.records())
      parameters += record.count;
    const auto count = static_cast<int>(records.records().size());
    const Handle(StepData_StepReaderData) data = new StepData_StepReaderData(
        static_cast<int>(records.headerRecords()), count, static_cast<int>(parameters), model->SourceCodePage());
    for (int i = 1; i <= count; ++i) {
      const StepRecords::Record& record = records.records()[static_cast<std::size_t>(i - 1)];
      data->SetRecord(i, record.name, record.type, record.count > 0 ? 1 : 0);
      for (std::size_t a = record.first; a < record.first + record.count; ++a)
        data->AddStepParam(i, records.arguments()[a].text, typeOf(records.arguments()[a].kind));
      data->InitParams(i);
    }
    StepData_StepReaderTool tool(data, protocol);
    tool.SetErrorHandle(Standard_True);
    const Handle(StepData_FileRecognizer) none;
    tool.PrepareHeader(none);
    tool.Prepare(none);
    tool.LoadModel(model);
    if (model->Protocol().IsNull()) model->SetProtocol(protocol);
    tool.Clear();
  }

  const std::string& bytes_;
};

}  // namespace

Handle(IFSelect_WorkLibrary) quickStepLibrary(const std::string& bytes) { return new QuickLibrary(bytes); }

}  // namespace probewright::simulation
