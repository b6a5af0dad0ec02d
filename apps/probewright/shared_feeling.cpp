#include "shared_feeling.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <linux/futex.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <ctime>
#include <thread>

namespace probewright::app {

namespace {

std::uint32_t load(const std::uint32_t& word) { return __atomic_load_n(&word, __ATOMIC_ACQUIRE); }
void store(std::uint32_t& word, std::uint32_t value) { __atomic_store_n(&word, value, __ATOMIC_RELEASE); }

void wake(std::uint32_t& word) { syscall(SYS_futex, &word, FUTEX_WAKE, 1, nullptr, nullptr, 0); }

/// Waits until `word` is no longer `value`, for a fifth of a second at most.
void waitWhile(std::uint32_t& word, std::uint32_t value) {
  const timespec patience{0, 200'000'000};
  syscall(SYS_futex, &word, FUTEX_WAIT, value, &patience, nullptr, 0);
}

bool isGone(std::int32_t process) { return kill(process, 0) != 0 && errno == ESRCH; }

/// The memory, as soon as its head is complete; null until then.
feel_exchange* map(const std::string& segment) {
  const int file = shm_open(segment.c_str(), O_RDWR, 0);
  if (file < 0) return nullptr;
  struct stat status = {};
  void* memory = MAP_FAILED;
  if (fstat(file, &status) == 0 && status.st_size >= static_cast<off_t>(sizeof(feel_exchange)))
    memory = mmap(nullptr, sizeof(feel_exchange), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  close(file);
  if (memory == MAP_FAILED) return nullptr;
  auto* exchange = static_cast<feel_exchange*>(memory);
  if (load(exchange->magic) == FEEL_MAGIC && load(exchange->closed) == 0) return exchange;
  munmap(memory, sizeof(feel_exchange));
  return nullptr;
}

}  // namespace

Result<SharedFeeling> SharedFeeling::open(const std::string& segment, std::chrono::seconds patience,
                                          const std::stop_token& stop) {
  const auto end = std::chrono::steady_clock::now() + patience;
  feel_exchange* memory = map(segment);
  while (memory == nullptr && std::chrono::steady_clock::now() < end && !stop.stop_requested()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    memory = map(segment);
  }
  if (memory == nullptr) {
    return fail(fmt::format("nobody has made the shared memory \"{}\"", segment),
                "LinuxCNC makes it when it loads probewright_feel (docs/linuxcnc.md); start both as the same user");
  }
  SharedFeeling shared(memory);
  if (memory->version != FEEL_VERSION || memory->size != sizeof(feel_exchange)) {
    return fail(fmt::format("the component probewright_feel in LinuxCNC speaks version {}, this program version {}",
                            memory->version, FEEL_VERSION),
                "Build and install both from the same version of Probewright");
  }
  return shared;
}

SharedFeeling::~SharedFeeling() {
  if (memory_ == nullptr) return;
  store(memory_->state, FEEL_ENDED);
  wake(memory_->answered);
  munmap(memory_, sizeof *memory_);
}

void SharedFeeling::serve(const std::function<std::uint32_t(const feel_exchange&)>& answer,
                          const std::stop_token& stop) {
  memory_->engine = getpid();
  store(memory_->state, FEEL_READY);
  while (!stop.stop_requested() && load(memory_->closed) == 0) {
    const std::uint32_t asked = load(memory_->asked);
    if (asked == memory_->answered) {
      waitWhile(memory_->asked, asked);
      if (load(memory_->asked) == asked && isGone(memory_->component)) return;
      continue;
    }
    memory_->answer = answer(*memory_);
    store(memory_->answered, asked);
    wake(memory_->answered);
  }
}

}  // namespace probewright::app
