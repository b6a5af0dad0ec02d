#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

/// Work that may crash, hang or eat all memory, done in a process of its own.
namespace probewright::simulation {

struct ChildLimits {
  double seconds = 600;                           ///< of the clock on the wall
  std::uint64_t bytes = std::uint64_t{8} << 30U;  ///< of memory beyond what its parent has
};

/// Bytes that a child has handed over. They are not copied, and stay as long as there is a copy of this.
class HandedBytes {
public:
  HandedBytes() = default;
  HandedBytes(std::shared_ptr<const void> pages, std::string_view bytes) : pages_(std::move(pages)), bytes_(bytes) {}

  std::string_view view() const { return bytes_; }

private:
  std::shared_ptr<const void> pages_;
  std::string_view bytes_;
};

/// The child's side: tells the parent what it does, and hands over what it has made. Any thread of the child may speak.
class ChildVoice {
public:
  /// `store`: a file for what is handed over.
  explicit ChildVoice(int descriptor, int store = -1) : descriptor_(descriptor), store_(store) {}
  /// One line; what is longer than 1000 bytes is cut, line ends become blanks.
  void say(std::string_view line) const;
  /// Bytes that the parent may use at once, while the child works on. Throws std::bad_alloc where there is no space.
  void hand(std::string_view bytes) const { hand('+', bytes); }

private:
  friend struct ChildLife;
  void hand(char kind, std::string_view bytes) const;

  int descriptor_;
  int store_;
};

/// How the child's work ended.
struct ChildEnd {
  enum class How {
    Finished,     ///< `result` is what the work returned; empty if the parent had all that it needs before
    Crashed,      ///< by `signal`, or with an exception (0)
    OutOfMemory,  ///< it wanted more than its limit
    OutOfTime,
    Ended,      ///< because the parent had enough
    NoProcess,  ///< none could be started, `result` says why
  };
  How how = How::Crashed;
  int signal = 0;
  std::string result;
};

/// Whether this process, a child, has come near the memory that it may have: what fails then fails for lack of it,
/// whatever a library says. Not known under an address sanitizer.
bool ranShortOfMemory();

/// Does `work` in a child process and waits for it. `heard` gets each line that the child says; `enough` is asked about
/// twenty times a second, told how many seconds of the processor the child has used, and ends the child by saying yes.
/// `given` gets what the child hands over, and says whether that was all: the child need not tidy up then.
/// The child has a copy of everything that its parent has, but
/// of the threads only the one that calls; its standard output goes nowhere.
ChildEnd inChild(const std::function<std::string(const ChildVoice&)>& work, const ChildLimits& limits,
                 const std::function<void(std::string_view line)>& heard,
                 const std::function<bool(double processorSeconds)>& enough,
                 const std::function<bool(HandedBytes bytes)>& given = {});

}  // namespace probewright::simulation
