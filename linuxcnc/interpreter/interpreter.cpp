// SPDX-License-Identifier: GPL-2.0-or-later
// The interpreter that a configuration of LinuxCNC names in [TASK]INTERPRETER: HEIDENHAIN and SINUMERIK programs are
// run by Probewright, everything else, manual input included, by LinuxCNC's own interpreter.
#include <dlfcn.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <utility>

#include <linuxcnc.h>
#include "canon.hh"
#include "emc.hh"
#include "interp_base.hh"
#include "interp_return.hh"
#include "modal_state.hh"
#include "player.hpp"

// The class of LinuxCNC's own interpreter has no header among those that it installs, but its constructor is known. It
// takes 200 kB in LinuxCNC 2.9.
extern "C" void _ZN6InterpC1Ev(void* place);

namespace {

InterpBase* ownInterpreter() {
  constexpr std::size_t plenty = std::size_t{1} << 20U;
  void* place = std::calloc(1, plenty);
  if (place == nullptr) std::abort();
  _ZN6InterpC1Ev(place);
  return static_cast<InterpBase*>(place);
}

/// Files of the controls that Probewright speaks for.
bool isOurs(const std::string& file) {
  const std::size_t dot = file.rfind('.');
  std::string ending = dot == std::string::npos ? "" : file.substr(dot + 1);
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  return ending == "h" || ending == "i" || ending == "mpf" || ending == "spf";
}

/// How many lines the file has; -1 if it cannot be read.
int linesOf(const std::string& file) {
  std::FILE* there = std::fopen(file.c_str(), "r");
  if (there == nullptr) return -1;
  int lines = 1;
  std::array<char, 65536> bytes;
  for (std::size_t count = 0; (count = std::fread(bytes.data(), 1, bytes.size(), there)) > 0;)
    lines += static_cast<int>(std::count(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(count), '\n'));
  std::fclose(there);
  return lines;
}

class Interpreter : public InterpBase {
public:
  ~Interpreter() override {
    gcode_->~InterpBase();
    std::free(gcode_);
  }
  int ini_load(const char* file) override {
    if (file != nullptr) ini_ = file;
    return gcode_->ini_load(file);
  }
  int init() override { return gcode_->init(); }

  int open(const char* file) override {
    settle(Player::Stop::ByOperator);
    message_.clear();
    file_ = isOurs(file) ? file : "";
    phase_ = Phase::Opened;
    if (file_.empty()) {
      if (!Mill::moves()) prepareDrawing();
      return gcode_->open(file);
    }
    lines_ = linesOf(file_);
    if (lines_ >= 0) return INTERP_OK;
    message_ = "cannot open " + file_;
    return INTERP_ERROR;
  }

  int read() override {
    given_ = false;
    if (file_.empty()) return gcode_->read();
    settle(Player::Stop::ByOperator);
    if (phase_ != Phase::Running) {
      if (Mill::moves() && findsStart()) return INTERP_OK;
      if (start_ < 0) {
        message_ = "LinuxCNC can verify programs of its own language only";
        return INTERP_ERROR;
      }
      phase_ = Phase::Running;
      // LinuxCNC's file of parameters, where offsets are read, it writes when it is told a mode: a program that is
      // started once more is told none.
      if (Mill::moves()) {
        if (const int result = restateOffset(); result > INTERP_MIN_ERROR) {
          message_ = errorText(result);
          return INTERP_ERROR;
        }
        gcode_->synch();
      }
      if (!player_.start(configuration(), file_, start_)) {
        message_ = player_.message();
        return INTERP_ERROR;
      }
    }
    if (!player_.playing()) return INTERP_ENDFILE;
    return read_ = next(player_.read()), read_ == INTERP_ERROR ? INTERP_ERROR : INTERP_OK;
  }
  int execute() override {
    if (file_.empty() || given_) return given_ = false, gcode_->execute();
    if (phase_ != Phase::Running) return INTERP_OK;
    if (read_ != INTERP_OK) {
      if (read_ == INTERP_EXIT) PROGRAM_END();
      return read_;
    }
    return next(player_.execute());
  }
  // milltask executes what read() has read with a null line; a line is manual input.
  int execute(const char* line) override {
    if (line == nullptr) return execute();
    message_.clear();
    return gcode_->execute(line);
  }
  int execute(const char* line, int number) override {
    if (line == nullptr) return execute();
    message_.clear();
    return gcode_->execute(line, number);
  }
  /// What a screen sets up before it draws a program.
  int read(const char* line) override { return given_ = true, gcode_->read(line); }

  // LinuxCNC closes a program at its end, and whenever it stops. Why it stops it says later, with on_abort(), or not at
  // all if it was the operator.
  int close() override {
    if (file_.empty()) return gcode_->close();
    closed_ = player_.playing();
    phase_ = Phase::Opened;
    return INTERP_OK;
  }
  int reset() override { return gcode_->reset(); }
  int on_abort(int reason, const char* message) override {
    closed_ = closed_ || player_.playing();
    settle(whyOf(reason));
    restatements_ = 0;
    return gcode_->on_abort(reason, message);
  }
  int synch() override {
    if (phase_ == Phase::Searching) {
      // The line before the one to start with has been reached.
      start_ = line_ + 1;
      phase_ = Phase::Found;
    }
    settle(Player::Stop::ByOperator);
    return gcode_->synch();
  }
  int exit() override {
    closed_ = player_.playing();
    settle(Player::Stop::ByOperator);
    return gcode_->exit();
  }

  char* error_text(int code, char* text, size_t size) override {
    if (message_.empty()) return gcode_->error_text(code, text, size);
    std::snprintf(text, size, "%s", message_.c_str());
    return text;
  }
  int line() override { return file_.empty() ? gcode_->line() : phase_ == Phase::Running ? player_.line() : line_; }
  int sequence_number() override { return file_.empty() ? gcode_->sequence_number() : line(); }
  int call_level() override {
    if (file_.empty()) return gcode_->call_level();
    // milltask asks for it after a block only if the program is not to run from its beginning.
    if (phase_ == Phase::Asking) phase_ = Phase::Searching;
    return 0;
  }
  size_t line_length() override { return file_.empty() ? gcode_->line_length() : 0; }
  char* line_text(char* text, size_t size) override {
    return ours(text, size, "") ? text : gcode_->line_text(text, size);
  }
  char* file_name(char* text, size_t size) override {
    return ours(text, size, file_) ? text : gcode_->file_name(text, size);
  }
  char* stack_name(int index, char* text, size_t size) override {
    return ours(text, size, "") ? text : gcode_->stack_name(index, text, size);
  }
  char* command(char* text, size_t size) override { return ours(text, size, "") ? text : gcode_->command(text, size); }
  char* file(char* text, size_t size) override {
    // milltask asks for it in each of its cycles.
    if (Mill::moves()) {
      if (const auto alarm = player_.attend()) Mill::tellError(*alarm);
      if (!player_.playing() && Mill::rests()) mendStatus();
    }
    return ours(text, size, file_) ? text : gcode_->file(text, size);
  }
  void active_g_codes(int codes[ACTIVE_G_CODES]) override { gcode_->active_g_codes(codes); }
  void active_m_codes(int codes[ACTIVE_M_CODES]) override { gcode_->active_m_codes(codes); }
  void active_settings(double values[ACTIVE_SETTINGS]) override { gcode_->active_settings(values); }
  int active_modes(int* g, int* m, double* settings, StateTag const& tag) override {
    return gcode_->active_modes(g, m, settings, tag);
  }
  int restore_from_tag(StateTag const& tag) override { return file_.empty() ? gcode_->restore_from_tag(tag) : 0; }
  void print_state_tag(StateTag const& tag) override { gcode_->print_state_tag(tag); }
  void set_loglevel(int level) override { gcode_->set_loglevel(level); }
  void set_loop_on_main_m99(bool state) override { gcode_->set_loop_on_main_m99(state); }

private:
  /// Where LinuxCNC says that a program is to begin: it asks for blocks and throws away what they do until the line
  /// before that one.
  enum class Phase {
    Opened,
    Asking,     ///< a block of nothing was read: is it thrown away?
    Searching,  ///< it is: blocks of nothing are read, line after line
    Found,
    Running
  };

  /// True if milltask is to be given a block of nothing.
  bool findsStart() {
    switch (phase_) {
      case Phase::Opened:
        phase_ = Phase::Asking;
        line_ = start_ = 0;
        return true;
      case Phase::Searching:
        if (line_ < lines_) return ++line_, true;
        start_ = -1;
        return false;
      case Phase::Asking:
      case Phase::Found:
      case Phase::Running:
        break;
    }
    return false;
  }

  void settle(Player::Stop why) {
    if (std::exchange(closed_, false)) player_.stop(why);
  }

  static Player::Stop whyOf(int reason) {
    switch (reason) {
      case EMC_ABORT_TASK_ABORT:
        return Player::Stop::ByOperator;
      case EMC_ABORT_AUX_ESTOP:
      case EMC_ABORT_TASK_STATE_ESTOP:
      case EMC_ABORT_TASK_STATE_ESTOP_RESET:
        return Player::Stop::EmergencyStop;
      case EMC_ABORT_TASK_STATE_OFF:
      case EMC_ABORT_TASK_STATE_NOT_ON:
        return Player::Stop::SwitchedOff;
      default:
        return Player::Stop::Fault;
    }
  }

  /// Sets the zero offset in effect anew, as it is, so that LinuxCNC's status tells it. After an emergency stop or an
  /// abort it may still tell the one of before: what was queued to be told to it is thrown away.
  int restateOffset() { return gcode_->execute("G10 L2 P0"); }

  /// After a stop, and once the results of a stopped program have been set as offsets.
  void mendStatus() {
    constexpr int attempts = 5;
    if (restatements_ >= attempts) return;
    if (Mill::statusIsTrue()) {
      restatements_ = attempts;
      return;
    }
    ++restatements_;
    restateOffset();
    Mill::flush();
  }

  std::string errorText(int result) {
    std::array<char, 256> text{};
    return gcode_->error_text(result, text.data(), text.size());
  }

  std::string configuration() const {
    const char* named = std::getenv("INI_FILE_NAME");
    return ini_.empty() && named != nullptr ? named : ini_;
  }

  /// Of configurations with an interpreter of their own screens do not say in which unit G-code begins.
  void prepareDrawing() {
    Mill mill;
    mill.load(configuration());
    for (const char* block : {mill.inInches() ? "G20" : "G21", "G90"}) {
      gcode_->read(block);
      gcode_->execute();
    }
  }

  /// Sets LinuxCNC's zero offsets and tools by blocks of G-code; why that cannot be, or nothing.
  std::string setTables(const Mill& mill, const EngineProcess::Json& tables) {
    std::array<int, ACTIVE_G_CODES> codes{};
    gcode_->active_g_codes(codes.data());
    const bool inches = std::find(codes.begin(), codes.end(), 200) != codes.end();
    const CANON_UNITS before = GET_EXTERNAL_LENGTH_UNIT_TYPE();
    std::string why;
    for (const std::string& block : mill.tableBlocks(tables)) {
      const int result = gcode_->execute(block.c_str());
      if (result <= INTERP_MIN_ERROR) continue;
      why = errorText(result);
      break;
    }
    if (inches) gcode_->execute("G20");
    USE_LENGTH_UNITS(before);
    restatements_ = 0;
    return why;
  }

  int next(Player::Next next) {
    switch (next) {
      case Player::Next::GoOn:
        return INTERP_OK;
      case Player::Next::Wait:
        return INTERP_EXECUTE_FINISH;
      case Player::Next::Ended:
        return INTERP_EXIT;
      case Player::Next::Failed:
        break;
    }
    message_ = player_.message();
    return INTERP_ERROR;
  }

  bool ours(char* text, size_t size, const std::string& value) const {
    if (file_.empty()) return false;
    std::snprintf(text, size, "%s", value.c_str());
    return true;
  }

  InterpBase* gcode_ = ownInterpreter();
  std::string ini_, file_, message_;
  Phase phase_ = Phase::Opened;
  int lines_ = 0, line_ = 0, start_ = 0;  ///< of the program: how many, the one of the search, where to begin
  bool given_ = false;                    ///< the block to execute was given as a line
  bool closed_ = false;                   ///< LinuxCNC has closed the program while it ran
  int read_ = INTERP_OK;                  ///< what the last read() wants execute() to say
  int restatements_ = 0;                  ///< how often the offset was set anew since the last stop
  Player player_{[this](const Mill& mill, const EngineProcess::Json& tables) { return setTables(mill, tables); }};
};

}  // namespace

extern "C" InterpBase* makeInterp() { return new Interpreter; }
