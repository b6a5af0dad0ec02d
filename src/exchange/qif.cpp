#include <fmt/format.h>

#include <algorithm>
#include <boost/uuid/name_generator.hpp>
#include <boost/uuid/uuid_io.hpp>
#include <pugixml.hpp>
#include <sstream>

#include "base/number_text.hpp"
#include "exchange/formats.hpp"

namespace probewright::exchange {

namespace {

using control::Quantity;
using control::Verdict;

/// The characteristic of QIF that a row is, without the words for its aspects; empty if it has no length and no angle.
std::string kindOf(const Row& row) {
  if (row.unit == "deg") return "UserDefinedAngularCharacteristic";
  if (row.unit != "mm") return {};
  switch (row.of.quantity) {
    case Quantity::Diameter:
      return "DiameterCharacteristic";
    case Quantity::Radius:
      return "RadiusCharacteristic";
    case Quantity::Width:
      return "WidthCharacteristic";
    case Quantity::Length:
      return "LengthCharacteristic";
    default:
      return "UserDefinedLinearCharacteristic";
  }
}

bool isUserDefined(const std::string& kind) { return kind.starts_with("UserDefined"); }

const char* statusOf(Verdict verdict) {
  switch (verdict) {
    case Verdict::None:
      return "NOT_ANALYZED";
    case Verdict::Good:
      return "PASS";
    case Verdict::Rework:
      return "REWORK";
    case Verdict::Scrap:
      return "FAIL";
  }
  return "UNDEFINED";
}

const char* statusOf(const Inspection& inspection) {
  const bool ended =
      inspection.run.exit == records::ExitState::Good || inspection.run.exit == records::ExitState::OutOfTolerance;
  if (!ended) return "SYSERROR";
  return inspection.verdict == Verdict::None ? "NOT_CALCULATED" : statusOf(inspection.verdict);
}

std::string decimal(double value) { return formatFixed(value, 9); }

/// Writes one document; every object gets the next number as its id.
class Writer {
public:
  explicit Writer(const Inspection& inspection) : inspection_(inspection) {
    for (const Row& row : inspection.rows) {
      if (std::string kind = kindOf(row); !kind.empty()) characteristics_.push_back({&row, std::move(kind), 0, 0, 0});
    }
  }

  std::string text() {
    pugi::xml_document document;
    pugi::xml_node declaration = document.append_child(pugi::node_declaration);
    declaration.append_attribute("version") = "1.0";
    declaration.append_attribute("encoding") = "UTF-8";
    pugi::xml_node root = document.append_child("QIFDocument");
    root.append_attribute("xmlns") = "http://qifstandards.org/xsd/qif3";
    root.append_attribute("versionQIF") = "3.0.0";
    put(root, "QPId", identity("document"));
    head(root);
    units(root);
    if (!characteristics_.empty()) {
      features(root);
      characteristics(root);
    }
    results(root);
    root.append_attribute("idMax") = lastId_;
    std::ostringstream text;
    document.save(text, "  ");
    return text.str();
  }

private:
  struct Characteristic {
    const Row* row;
    std::string kind;
    unsigned definition, nominal, item;
  };
  /// What one call of a cycle measured.
  struct Feature {
    const Row* row;
    unsigned definition, nominal, item;
  };

  static pugi::xml_node put(pugi::xml_node parent, const char* name, const std::string& value) {
    pugi::xml_node node = parent.append_child(name);
    node.text().set(value.c_str());
    return node;
  }

  unsigned number(pugi::xml_node node) {
    node.append_attribute("id") = ++lastId_;
    return lastId_;
  }

  /// The same run gives the same identity, another one another.
  std::string identity(const std::string& of) const {
    const records::RunInfo& run = inspection_.run;
    std::string name = fmt::format("{}\n{}\n{}\n{}", of, run.startedAt, run.version,
                                   run.programs.empty() ? "" : run.programs.front().path);
    for (const Row& row : inspection_.rows)
      name += fmt::format("\n{} {}", row.result, row.actual);
    static const boost::uuids::name_generator_sha1 generate(boost::uuids::ns::url());
    return boost::uuids::to_string(generate(name));
  }

  void head(pugi::xml_node root) {
    const records::RunInfo& run = inspection_.run;
    pugi::xml_node header = root.append_child("Header");
    pugi::xml_node application = header.append_child("Application");
    put(application, "Name", "Probewright " + run.version);
    put(header, "Description",
        fmt::format("{}, part {}{}{}, control {}, machine {}", run.programs.empty() ? "" : run.programs.front().path,
                    run.partName, run.partPath.empty() ? "" : " ", run.partPath, run.control, run.machine));
    pugi::xml_node standards = root.append_child("StandardsDefinitions");
    standards.append_attribute("n") = 1;
    pugi::xml_node standard = standards.append_child("Standard");
    standard_ = number(standard);
    put(standard.append_child("Organization"), "StandardsOrganizationEnum", "ISO");
    put(standard, "Designator", "ISO 14405-1");
  }

  static void units(pugi::xml_node root) {
    pugi::xml_node primary = root.append_child("FileUnits").append_child("PrimaryUnits");
    pugi::xml_node angle = primary.append_child("AngularUnit");
    put(angle, "SIUnitName", "radian");
    put(angle, "UnitName", "degree");
    put(angle.append_child("UnitConversion"), "Factor", "0.017453292519943295");
    pugi::xml_node length = primary.append_child("LinearUnit");
    put(length, "SIUnitName", "meter");
    put(length, "UnitName", "mm");
    put(length.append_child("UnitConversion"), "Factor", "0.001");
  }

  pugi::xml_node list(pugi::xml_node parent, const char* name) const {
    pugi::xml_node node = parent.append_child(name);
    node.append_attribute("n") = static_cast<unsigned long long>(characteristics_.size());
    return node;
  }

  static void tolerance(pugi::xml_node definition, const Row& row) {
    if (!row.lowerLimit && !row.upperLimit) {
      put(definition, "NonTolerance", "MEASURED");
      return;
    }
    pugi::xml_node node = definition.append_child("Tolerance");
    if (row.upperLimit) put(node, "MaxValue", decimal(*row.upperLimit));
    if (row.lowerLimit) put(node, "MinValue", decimal(*row.lowerLimit));
    put(node, "DefinedAsLimit", "true");
  }

  /// A feature for each call: its name, and which characteristics are its own. Its geometry stays in the control.
  void features(pugi::xml_node root) {
    for (const Characteristic& each : characteristics_)
      if (features_.empty() || features_.back().row->cycle != each.row->cycle) features_.push_back({each.row, 0, 0, 0});
    const auto counted = [&](pugi::xml_node parent, const char* name) {
      pugi::xml_node node = parent.append_child(name);
      node.append_attribute("n") = static_cast<unsigned long long>(features_.size());
      return node;
    };
    const auto name = [](const Row& row) {
      return fmt::format("{} {}", row.cycle, row.feature.empty() ? row.cycleName + " " + row.title : row.feature);
    };
    pugi::xml_node lists = root.append_child("Features");
    pugi::xml_node definitions = counted(lists, "FeatureDefinitions");
    for (Feature& each : features_) {
      pugi::xml_node node = definitions.append_child("OtherShapeFeatureDefinition");
      each.definition = number(node);
      put(node, "Description", each.row->cycleName + " " + each.row->title);
    }
    pugi::xml_node nominals = counted(lists, "FeatureNominals");
    for (Feature& each : features_) {
      pugi::xml_node node = nominals.append_child("OtherShapeFeatureNominal");
      each.nominal = number(node);
      put(node, "Name", name(*each.row));
      put(node, "FeatureDefinitionId", std::to_string(each.definition));
    }
    pugi::xml_node items = counted(lists, "FeatureItems");
    for (Feature& each : features_) {
      pugi::xml_node node = items.append_child("OtherShapeFeatureItem");
      each.item = number(node);
      put(node, "FeatureNominalId", std::to_string(each.nominal));
      put(node, "FeatureName", name(*each.row));
      node.append_child("DeterminationMode").append_child("Checked");
    }
  }

  unsigned featureOf(const Row& row) const {
    return std::ranges::find_if(features_, [&](const Feature& each) { return each.row->cycle == row.cycle; })->item;
  }

  void characteristics(pugi::xml_node root) {
    pugi::xml_node aspects = root.append_child("Characteristics");
    put(aspects, "FormalStandardId", std::to_string(standard_));
    pugi::xml_node definitions = list(aspects, "CharacteristicDefinitions");
    for (Characteristic& each : characteristics_) {
      pugi::xml_node node = definitions.append_child((each.kind + "Definition").c_str());
      each.definition = number(node);
      put(node, "Name", nameOf(*each.row));
      tolerance(node, *each.row);
      if (isUserDefined(each.kind)) put(node, "WhatToMeasure", each.row->characteristic);
    }
    pugi::xml_node nominals = list(aspects, "CharacteristicNominals");
    for (Characteristic& each : characteristics_) {
      pugi::xml_node node = nominals.append_child((each.kind + "Nominal").c_str());
      each.nominal = number(node);
      put(node, "CharacteristicDefinitionId", std::to_string(each.definition));
      put(node, "Name", nameOf(*each.row));
      if (each.row->nominal) put(node, "TargetValue", decimal(*each.row->nominal));
    }
    pugi::xml_node items = list(aspects, "CharacteristicItems");
    for (Characteristic& each : characteristics_) {
      pugi::xml_node node = items.append_child((each.kind + "Item").c_str());
      each.item = number(node);
      put(node, "Description",
          fmt::format("{} {}, {} line {}, {}", each.row->cycleName, each.row->title, each.row->program, each.row->line,
                      each.row->result));
      put(node, "Name", nameOf(*each.row));
      pugi::xml_node of = node.append_child("FeatureItemIds");
      of.append_attribute("n") = 1;
      put(of, "Id", std::to_string(featureOf(*each.row)));
      put(node, "CharacteristicNominalId", std::to_string(each.nominal));
    }
  }

  /// Who measured which part on whose order, and when.
  void traceability(pugi::xml_node results) const {
    const records::RunInfo& run = inspection_.run;
    const records::Job& job = run.job;
    const bool named = std::ranges::any_of(records::jobFields,
                                           [&](const records::JobField& field) { return !(job.*field.value).empty(); });
    if (run.startedAt.empty() && !named) return;
    pugi::xml_node node = results.append_child("InspectionTraceability");
    if (!job.company.empty()) put(node.append_child("InspectingOrganization"), "Name", job.company);
    if (!job.order.empty()) put(node, "OrderNumber", job.order);
    if (!run.startedAt.empty()) put(node, "InspectionStart", run.startedAt);
    if (!job.operator_.empty()) put(node.append_child("InspectionOperator"), "Name", job.operator_);
    pugi::xml_node attributes;
    unsigned count = 0;
    for (const auto& [name, value] :
         {std::pair("part", &job.part), std::pair("drawing", &job.drawing), std::pair("serial", &job.serial)}) {
      if (value->empty()) continue;
      if (!attributes) attributes = node.append_child("Attributes");
      pugi::xml_node attribute = attributes.append_child("AttributeStr");
      attribute.append_attribute("name") = name;
      attribute.append_attribute("value") = value->c_str();
      ++count;
    }
    if (attributes) attributes.append_attribute("n") = count;
  }

  void results(pugi::xml_node root) {
    pugi::xml_node set = root.append_child("Results").append_child("MeasurementResultsSet");
    set.append_attribute("n") = 1;
    pugi::xml_node results = set.append_child("MeasurementResults");
    number(results);
    const records::RunInfo& run = inspection_.run;
    traceability(results);
    put(results, "ThisResultsInstanceQPId", identity("results"));
    if (!characteristics_.empty()) {
      pugi::xml_node measurements = list(results.append_child("MeasuredCharacteristics"), "CharacteristicMeasurements");
      for (const Characteristic& each : characteristics_) {
        pugi::xml_node node = measurements.append_child((each.kind + "Measurement").c_str());
        number(node);
        put(node.append_child("Status"), "CharacteristicStatusEnum", statusOf(each.row->verdict));
        put(node, "CharacteristicItemId", std::to_string(each.item));
        if (const std::string time = timeOf(*each.row, run); !time.empty()) put(node, "TimeStamp", time + "Z");
        put(node, "Value", decimal(each.row->actual));
      }
    }
    put(results.append_child("InspectionStatus"), "InspectionStatusEnum", statusOf(inspection_));
  }

  const Inspection& inspection_;
  std::vector<Characteristic> characteristics_;
  std::vector<Feature> features_;
  unsigned lastId_ = 0;
  unsigned standard_ = 0;
};

}  // namespace

std::string qifText(const Inspection& inspection) { return Writer(inspection).text(); }

}  // namespace probewright::exchange
