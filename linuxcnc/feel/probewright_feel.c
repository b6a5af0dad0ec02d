/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * A realtime HAL component that gives a simulated LinuxCNC machine a probe which feels a virtual part. Each servo cycle it
 * hands the positions of the axes to `probewright feel` and waits for what that feels, so that the signal belongs to
 * exactly these positions, however the processes are scheduled. See feel_exchange.h for what is exchanged and
 * docs/linuxcnc.md for how to use it.
 *
 * This is for axes that are simulated: the servo thread waits for another process. Never load it on a machine that moves.
 */
#include <errno.h>
#include <fcntl.h>
#include <linux/futex.h>
#include <signal.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

#include "rtapi.h"
#include "rtapi_app.h"
#include "hal.h"

#include "feel_exchange.h"

MODULE_AUTHOR("The Probewright authors");
MODULE_DESCRIPTION("Probe signals from the virtual part of Probewright");
MODULE_LICENSE("GPL");

static char *segment = "/probewright-feel";
RTAPI_MP_STRING(segment, "name of the shared memory");
static char *axes = "XYZ";
RTAPI_MP_STRING(axes, "letters of the axes that are connected");
static int wait_ms = 10000;
RTAPI_MP_INT(wait_ms, "how long a servo cycle waits for an answer, in milliseconds");

struct pins {
  hal_float_t *axis[FEEL_AXES]; /* null if not connected */
  hal_float_t *mm_per_unit;
  hal_float_t *spindle_speed, *spindle_angle;
  hal_s32_t *tool;
  hal_bit_t *reset;
  hal_bit_t *touch, *tool_touch, *probe, *by_stylus;
  hal_bit_t *collision, *ready, *ok;
  hal_u32_t *late;
  hal_float_t *latency, *latency_max;
};

static int component;
static struct pins *pins;
static struct feel_exchange *shared;
static bool was_reset, was_ready;
static double elapsed; /* seconds since the question before */

static uint32_t get(const uint32_t *word) { return __atomic_load_n(word, __ATOMIC_ACQUIRE); }
static void put(uint32_t *word, uint32_t value) { __atomic_store_n(word, value, __ATOMIC_RELEASE); }
static void wake(uint32_t *word) { syscall(SYS_futex, word, FUTEX_WAKE, 1, NULL, NULL, 0); }

static bool engine_is_gone(void) { return kill(shared->engine, 0) != 0 && errno == ESRCH; }

/* Waits until the question is answered, the engine has left or died, or the time is over. */
static bool answered_within(long long nanoseconds) {
  const long long begin = rtapi_get_time();
  for (;;) {
    const uint32_t answered = get(&shared->answered);
    if (answered == get(&shared->asked)) return true;
    const long long left = nanoseconds - (rtapi_get_time() - begin);
    if (left <= 0 || get(&shared->state) != FEEL_READY) return false;
    struct timespec patience = {0, left < 100000000 ? left : 100000000};
    syscall(SYS_futex, &shared->answered, FUTEX_WAIT, answered, &patience, NULL, 0);
    if (get(&shared->answered) == answered && engine_is_gone()) return false;
  }
}

static void ask(void) {
  int i;
  for (i = 0; i < FEEL_AXES; ++i) {
    if (!pins->axis[i]) continue;
    const bool rotary = i >= 3 && i <= 5;
    shared->axis[i] = *pins->axis[i] * (rotary ? 1 : *pins->mm_per_unit);
  }
  shared->tool = *pins->tool;
  shared->spindle_speed = *pins->spindle_speed;
  shared->spindle_angle = *pins->spindle_angle;
  shared->seconds = elapsed;
  elapsed = 0;
  put(&shared->asked, shared->asked + 1);
  wake(&shared->asked);
}

static void feel(void *unused, long period) {
  (void)unused;
  const bool here = get(&shared->state) == FEEL_READY;
  bool current = false;
  elapsed += period * 1e-9;
  if (*pins->reset && !was_reset) *pins->collision = 0;
  if (here) {
    /* A question that the engine still owes an answer to is not waited for again. */
    const bool owed = get(&shared->answered) != get(&shared->asked);
    if (!owed) {
      const long long begin = rtapi_get_time();
      if (*pins->reset && !was_reset) ++shared->resets;
      was_reset = *pins->reset;
      ask();
      current = answered_within(wait_ms * 1000000ll);
      *pins->latency = (rtapi_get_time() - begin) * 1e-9;
      if (*pins->latency > *pins->latency_max) *pins->latency_max = *pins->latency;
    }
    if (!current) ++*pins->late;
  }
  if (current) {
    const uint32_t answer = shared->answer;
    *pins->touch = (answer & FEEL_TOUCH) != 0;
    *pins->tool_touch = (answer & FEEL_TOOL_TOUCH) != 0;
    *pins->by_stylus = (answer & FEEL_BY_STYLUS) != 0;
    if (answer & FEEL_COLLISION) *pins->collision = 1;
  }
  if (was_ready && !current) rtapi_print_msg(RTAPI_MSG_ERR, "probewright_feel: the engine does not answer\n");
  was_ready = current;
  *pins->probe = *pins->touch || *pins->tool_touch;
  *pins->ready = current;
  *pins->ok = current && !*pins->collision;
}

static int make_pins(void) {
  static const char letters[] = "xyzabcuvw";
  int i, bad = 0;
  const char *letter;
  for (letter = axes; *letter; ++letter) {
    const char *found = strchr(letters, *letter | 0x20);
    if (!found) {
      rtapi_print_msg(RTAPI_MSG_ERR, "probewright_feel: axes=%s: there is no axis %c\n", axes, *letter);
      return -EINVAL;
    }
    shared->axes |= 1u << (found - letters);
  }
  for (i = 0; i < FEEL_AXES; ++i) {
    if (shared->axes & (1u << i))
      bad |= hal_pin_float_newf(HAL_IN, &pins->axis[i], component, "probewright-feel.axis-%c", letters[i]);
  }
  bad |= hal_pin_float_newf(HAL_IN, &pins->mm_per_unit, component, "probewright-feel.mm-per-unit");
  bad |= hal_pin_float_newf(HAL_IN, &pins->spindle_speed, component, "probewright-feel.spindle-speed");
  bad |= hal_pin_float_newf(HAL_IN, &pins->spindle_angle, component, "probewright-feel.spindle-angle");
  bad |= hal_pin_s32_newf(HAL_IN, &pins->tool, component, "probewright-feel.tool-number");
  bad |= hal_pin_bit_newf(HAL_IN, &pins->reset, component, "probewright-feel.reset");
  bad |= hal_pin_bit_newf(HAL_OUT, &pins->touch, component, "probewright-feel.touch");
  bad |= hal_pin_bit_newf(HAL_OUT, &pins->tool_touch, component, "probewright-feel.tool-touch");
  bad |= hal_pin_bit_newf(HAL_OUT, &pins->probe, component, "probewright-feel.probe");
  bad |= hal_pin_bit_newf(HAL_OUT, &pins->by_stylus, component, "probewright-feel.by-stylus");
  bad |= hal_pin_bit_newf(HAL_OUT, &pins->collision, component, "probewright-feel.collision");
  bad |= hal_pin_bit_newf(HAL_OUT, &pins->ready, component, "probewright-feel.ready");
  bad |= hal_pin_bit_newf(HAL_OUT, &pins->ok, component, "probewright-feel.ok");
  bad |= hal_pin_u32_newf(HAL_OUT, &pins->late, component, "probewright-feel.late");
  bad |= hal_pin_float_newf(HAL_OUT, &pins->latency, component, "probewright-feel.latency");
  bad |= hal_pin_float_newf(HAL_IO, &pins->latency_max, component, "probewright-feel.latency-max");
  bad |= hal_export_funct("probewright-feel", feel, NULL, 1, 0, component);
  if (!bad) *pins->mm_per_unit = 1;
  return bad ? -EINVAL : 0;
}

static int make_shared(void) {
  shm_unlink(segment);
  const int file = shm_open(segment, O_RDWR | O_CREAT | O_EXCL, 0600);
  if (file < 0 || ftruncate(file, sizeof *shared) != 0) {
    rtapi_print_msg(RTAPI_MSG_ERR, "probewright_feel: cannot make the shared memory %s: %s\n", segment, strerror(errno));
    if (file >= 0) close(file);
    return -ENOMEM;
  }
  shared = mmap(NULL, sizeof *shared, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  close(file);
  if (shared == MAP_FAILED) {
    shared = NULL;
    return -ENOMEM;
  }
  shared->version = FEEL_VERSION;
  shared->size = sizeof *shared;
  shared->component = getpid();
  return 0;
}

static void leave(void) {
  if (shared) {
    put(&shared->closed, 1);
    put(&shared->asked, shared->asked + 1);
    wake(&shared->asked);
    munmap(shared, sizeof *shared);
    shm_unlink(segment);
  }
  hal_exit(component);
}

int rtapi_app_main(void) {
  component = hal_init("probewright_feel");
  if (component < 0) return component;
  pins = hal_malloc(sizeof *pins);
  int bad = pins ? 0 : -ENOMEM;
  if (!bad) {
    memset(pins, 0, sizeof *pins);
    bad = make_shared();
  }
  if (!bad) bad = make_pins();
  if (bad) {
    leave();
    return bad;
  }
  put(&shared->magic, FEEL_MAGIC);
  hal_ready(component);
  return 0;
}

void rtapi_app_exit(void) { leave(); }
