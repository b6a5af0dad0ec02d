/* SPDX-License-Identifier: Apache-2.0 OR GPL-2.0-or-later
 *
 * What the HAL component probewright_feel and the program `probewright feel` exchange: one piece of shared memory (POSIX
 * shm_open) with one question and its answer. Whoever wants to ask from elsewhere writes to the same layout.
 *
 * The component makes the memory, fills in the head and stores `magic` last. The engine opens it, reads its setup, and
 * stores FEEL_READY in `state`. From then on, once per servo cycle:
 *
 *   component: writes the fields of the question, adds 1 to `asked`, wakes who waits for `asked` (FUTEX_WAKE)
 *   engine:    reads the question, writes the answer, sets `answered` to `asked`, wakes who waits for `answered`
 *
 * While `asked` differs from `answered` the question belongs to the engine, otherwise to the component. A component that
 * leaves stores 1 in `closed` and wakes `asked`; an engine that leaves stores FEEL_ENDED in `state` and wakes `answered`.
 * The words `asked`, `answered`, `state`, `closed` and `magic` are read with acquire and written with release order.
 */
#ifndef PROBEWRIGHT_FEEL_EXCHANGE_H
#define PROBEWRIGHT_FEEL_EXCHANGE_H

#include <stdint.h>

#define FEEL_MAGIC 0x4c454650u /* "PFEL" */
#define FEEL_VERSION 2u        /* of this layout; counted up with every change */
#define FEEL_AXES 9            /* X Y Z A B C U V W, in this order */

enum { FEEL_STARTING = 0, FEEL_READY = 1, FEEL_ENDED = 2 }; /* state */

enum {                      /* answer, bits */
  FEEL_TOUCH = 1,           /* the touch probe signals */
  FEEL_TOOL_TOUCH = 2,      /* the tool touch probe signals */
  FEEL_COLLISION = 4,       /* something touches that must not, or a stylus is pushed too far */
  FEEL_BY_STYLUS = 8        /* with FEEL_TOUCH: the stylus touched, not the ball */
};

struct feel_exchange {
  /* head */
  uint32_t magic;
  uint32_t version;
  uint32_t size;          /* of this struct */
  int32_t component;      /* process id of the component */
  int32_t engine;         /* process id of the engine, stored before FEEL_READY */
  uint32_t axes;          /* bit i: axis i of the question is filled in */
  uint32_t state;
  uint32_t closed;
  uint32_t asked;
  uint32_t answered;
  /* question */
  int32_t tool;           /* number of the tool in the spindle; 0 for none */
  uint32_t resets;        /* counts; a new value: pull off what a collision left touching */
  uint32_t answer;        /* the answer */
  double seconds;         /* since the question before */
  double spindle_speed;   /* revolutions/min, above 0 clockwise (M3) */
  double spindle_angle;   /* degrees, to which the spindle was oriented last (M19 R) */
  double axis[FEEL_AXES]; /* where the axes stand in the machine coordinate system, mm and degrees */
};

#endif
