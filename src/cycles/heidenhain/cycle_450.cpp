#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "base/number_text.hpp"
#include "base/text.hpp"
#include "base/utc.hpp"
#include "control/alarm.hpp"
#include "control/heidenhain/kinematic_tables.hpp"
#include "cycles/heidenhain/call_rules.hpp"
#include "cycles/heidenhain/context.hpp"
#include "cycles/heidenhain/kinematics_log.hpp"
#include "cycles/heidenhain/kinematics_plan.hpp"
#include "cycles/heidenhain/parameters.hpp"

namespace probewright::cycles::heidenhain {
namespace {

using namespace parameters;
using control::Alarm;
using control::heidenhain::KinematicData;
using control::heidenhain::KinematicEntry;
using control::heidenhain::Kinematics;
using control::heidenhain::SavedKinematics;

constexpr std::size_t placesTNC640 = 16, longestName = 16;

constexpr Choice modes[] = {{0, "save the active kinematics"},
                            {1, "restore a record"},
                            {2, "show the records"},
                            {3, "delete records (TNC 640)", control::onTNC640}};

constexpr Parameter parameters450[] = {
    option(410, "Q410", "mode", modes),
    {.name = "Q409",
     .address = 409,
     .meaning = "record: a number (iTNC 530: 0 to 9), or on the TNC 640 a name of up to 16 characters as QS409, when "
                "restoring and deleting with the wildcards ? $ # *",
     .kind = ValueKind::NumberOrText,
     .minimum = 0,
     .maximum = 99999,
     .narrower = {.controls = control::onITNC530, .maximum = 9, .text = false}},
};

constexpr int Save = 0, Restore = 1, Show = 2, Delete = 3;

/// ? any character, $ a letter, # a digit, * any characters.
bool matches(std::string_view name, std::string_view pattern) {
  if (pattern.empty()) return name.empty();
  if (pattern.front() == '*') {
    for (std::size_t skipped = 0; skipped <= name.size(); ++skipped) {
      if (matches(name.substr(skipped), pattern.substr(1))) return true;
    }
    return false;
  }
  if (name.empty()) return false;
  const char first = name.front();
  const char sign = pattern.front();
  const bool fits = sign == '?'   ? true
                    : sign == '$' ? isLetter(first)
                    : sign == '#' ? isDigit(first)
                                  : sign == name.front();
  return fits && matches(name.substr(1), pattern.substr(1));
}

std::string recordName(const Arguments& arguments) {
  const Argument& given = arguments.at(409);
  return given.isText ? given.text : formatShortest(given.number);
}

/// What is wrong with the name of a record, if anything is.
std::string nameMistake(std::string_view name, int mode) {
  if (name.empty()) return "QS409 is empty";
  if (name.size() > longestName) return fmt::format("\"{}\" has more than {} characters", name, longestName);
  if (mode == Save && name.find_first_of("?$#*") != name.npos)
    return fmt::format("\"{}\" has a wildcard; they search records, they do not name them", name);
  if (name.find_first_of(" \t") != name.npos) return fmt::format("\"{}\" has a blank", name);
  return {};
}

void rules(CallRules& call) {
  const auto mode = call.number(410);
  const auto name = call.value(409);
  if (call.kind() == ControlKind::iTNC530) {
    if (mode == Delete) call.add(410, "the iTNC 530 deletes no records: Q410 is 0, 1 or 2", "overwrite the record");
    if (name && name->isText) call.add(409, "records of the iTNC 530 have numbers", "write Q409 with 0 to 9");
    if (name && !name->isText && name->number > 9)
      call.add(409, "the iTNC 530 has the memory places 0 to 9", "write Q409 with 0 to 9");
    return;
  }
  if (!mode || !name || !name->isText || *mode == Show) return;
  if (const std::string mistake = nameMistake(name->text, static_cast<int>(*mode)); !mistake.empty())
    call.add(409, mistake, "write up to 16 letters, digits and signs");
}

std::string now(Context& context) {
  const auto& control = context.control();
  return fmt::format("{:%Y-%m-%d_%H:%M:%S}",
                     utcTime(control.wallClockStart, context.channel().seconds() - control.startSeconds));
}

/// The mean of each entry over the records.
std::vector<KinematicEntry> meanOf(const std::vector<const SavedKinematics*>& records) {
  std::vector<KinematicEntry> mean = records.front()->entries;
  for (std::size_t i = 0; i < mean.size(); ++i) {
    double sum = 0;
    for (const SavedKinematics* record : records)
      sum += record->entries[i].value;
    mean[i].value = sum / static_cast<double>(records.size());
  }
  return mean;
}

Alarm notFound(const std::string& name) {
  return {"Kinematics record not found", fmt::format("No record of DATA450.KD fits {}", name),
          "show the records with Q410 = 2"};
}

class Records {
public:
  explicit Records(Context& context) : context_(context), kinematics_(*context.control().kinematics) {
    if (!kinematics_.saved) return;
    if (kinematics_.saved->table().keys().empty()) {
      throw Alarm("Kinematics memory empty", "DATA450.KD is there and holds no record",
                  "delete the file and start the cycle again");
    }
    records_ = savedKinematicsOf(*kinematics_.saved);
  }

  const std::vector<SavedKinematics>& all() const { return records_; }

  std::vector<const SavedKinematics*> fitting(const std::string& pattern) const {
    std::vector<const SavedKinematics*> found;
    for (const SavedKinematics& record : records_) {
      if (context_.control().isTNC640() ? matches(record.name, pattern) : record.name == pattern)
        found.push_back(&record);
    }
    return found;
  }

  void save(const SavedKinematics& record) {
    const auto known = std::ranges::find(records_, record.name, &SavedKinematics::name);
    if (known != records_.end()) {
      if (known->code != 0 && known->code != record.code) {
        throw Alarm("Memory place protected",
                    fmt::format("Memory place {} was saved with another code number", record.name),
                    "enter that code number under MOD (codeNumber in [parameters]), or use another place");
      }
      *known = record;
    } else {
      if (records_.size() >= placesTNC640) {
        throw Alarm("Kinematics memory full", fmt::format("There are {} records, and no more can be", placesTNC640),
                    "delete a record with Q410 = 3, or overwrite one");
      }
      records_.push_back(record);
    }
    write();
  }

  void remove(const std::vector<std::string>& names) {
    std::erase_if(records_,
                  [&](const SavedKinematics& record) { return std::ranges::find(names, record.name) != names.end(); });
    write();
  }

private:
  /// The table as a whole; without records there is none.
  void write() {
    if (records_.empty()) {
      kinematics_.saved.reset();
    } else {
      kinematics_.saved = savedKinematicsTable(records_, context_.control().kind());
    }
  }

  Context& context_;
  Kinematics& kinematics_;
  std::vector<SavedKinematics> records_;
};

void note(Context& context, const std::string& record, const std::string& before, const std::string& after) {
  context.control().journal.write({control::heidenhain::savedKinematicsName, "record " + record, before, after});
}

KinematicsLog::Rows listOf(const std::vector<SavedKinematics>& records) {
  KinematicsLog::Rows rows;
  for (const SavedKinematics& record : records)
    rows.push_back({record.name, record.code == 0 ? "" : std::to_string(record.code), record.identifier, record.date});
  return rows;
}

const std::vector<std::string> listHeading = {"Record", "Code number", "Kinematics", "Saved on"};

void save(Context& context, Records& records, const std::string& name, KinematicsLog& log) {
  const Kinematics& kinematics = *context.control().kinematics;
  SavedKinematics record{name, now(context), kinematics.identifier(), context.control().parameters.codeNumber,
                         kinematics.entries(kinematics.data())};
  if (context.control().isTNC640()) record.code = 0;
  const auto known = records.fitting(name);
  const std::string before = known.empty() ? "" : known.front()->date;
  records.save(record);
  note(context, name, before, record.date);
  KinematicsLog::Rows rows;
  for (const KinematicEntry& entry : record.entries)
    rows.push_back({entry.key, entry.axis, formatFixed(entry.value, 7)});
  log.table({"Entry", "Axis", "Value"}, rows);
}

void restore(Context& context, const Records& records, const std::string& name, KinematicsLog& log) {
  auto& control = context.control();
  const Kinematics& kinematics = *control.kinematics;
  const auto found = records.fitting(name);
  if (found.empty()) throw notFound(name);
  for (const SavedKinematics* record : found) {
    if (const auto fits = kinematics.dataOf(record->entries); !fits || record->identifier != kinematics.identifier()) {
      throw Alarm("Kinematics not identical",
                  fmt::format("Record {} was saved from another kinematics ({}; {} is active)", record->name,
                              record->identifier, kinematics.identifier()),
                  "restore a record of the active kinematics");
    }
  }
  const std::vector<KinematicEntry> before = kinematics.entries(kinematics.data());
  const KinematicData data = *kinematics.dataOf(meanOf(found));
  changeKinematics(control, data);
  const std::vector<KinematicEntry> after = kinematics.entries(data);
  KinematicsLog::Rows rows;
  for (std::size_t i = 0; i < after.size(); ++i)
    rows.push_back({after[i].key, after[i].axis, formatFixed(before[i].value, 7), formatFixed(after[i].value, 7)});
  log.table({"Entry", "Axis", "Before", "After"}, rows);
}

void show(Context& context, const Records& records, KinematicsLog& log) {
  const KinematicsLog::Rows rows = listOf(records.all());
  log.table(listHeading, rows);
  std::string screen = "Saved kinematics:";
  for (const auto& row : rows)
    screen += fmt::format("\n{}  {}  {}  {}", row[0], row[1].empty() ? "-" : row[1], row[2], row[3]);
  if (rows.empty()) screen += " none";
  context.record().screens.push_back(screen);
}

void remove(Context& context, Records& records, const std::string& name, KinematicsLog& log) {
  const auto found = records.fitting(name);
  if (found.empty()) throw notFound(name);
  std::vector<SavedKinematics> gone;
  std::vector<std::string> names;
  for (const SavedKinematics* record : found) {
    gone.push_back(*record);
    names.push_back(record->name);
  }
  if (name.find_first_of("?$#*") != name.npos)
    context.stop(fmt::format("Delete {} records that fit {}? NC start deletes them", gone.size(), name));
  records.remove(names);
  for (const SavedKinematics& record : gone)
    note(context, record.name, record.date, "");
  log.table(listHeading, listOf(gone));
}

void run(Context& context, const Arguments& arguments) {
  auto& control = context.control();
  requireKinematicsOption(context);
  const int mode = context.option(410);
  const std::string name = recordName(arguments);
  if (!control.isTNC640()) {
    const Argument& given = arguments.at(409);
    if (mode == Delete || given.isText || given.number > 9) {
      throw Alarm("Cycle parameter wrong", "The iTNC 530 has the memory places 0 to 9, and Q410 0 to 2",
                  "correct Q409 and Q410");
    }
  } else if (const std::string mistake = nameMistake(name, mode); mode != Show && !mistake.empty()) {
    throw Alarm("Cycle parameter wrong", mistake, "write up to 16 letters, digits and signs");
  }
  Records records(context);
  KinematicsLog log(context, control.isTNC640() ? "TCHPRAUTO.html" : "TCHPR450.TXT");
  log.line("Mode", fmt::format("{}: {}", mode, modes[mode].meaning));
  if (mode != Show) log.line("Record", name);
  log.line("Kinematics", control.kinematics->identifier());
  if (!control.isTNC640() && control.parameters.codeNumber != 0)
    log.line("Code number", std::to_string(control.parameters.codeNumber));
  switch (mode) {
    case Save:
      save(context, records, name, log);
      break;
    case Restore:
      restore(context, records, name, log);
      break;
    case Show:
      show(context, records, log);
      break;
    default:
      remove(context, records, name, log);
  }
  log.write();
}

constexpr CycleDefinition definition = {
    .number = 450,
    .name = "450",
    .title = "SAVE KINEMATICS",
    .family = CycleFamily::Kinematics,
    .summary =
        "Saves the active kinematics as a record of DATA450.KD, restores one, shows the records or deletes "
        "them. No axis moves.",
    .parameters = parameters450,
};

}  // namespace

extern const Entry cycle450 = {
    .definition = definition,
    .conditions = {.uses = Uses::Nothing, .under = Transformed::Any, .turningMode = true, .featureLevel = 3},
    .logTerms = kinematicsLogTerms,
    .rules = rules,
    .run = run};

}  // namespace probewright::cycles::heidenhain
