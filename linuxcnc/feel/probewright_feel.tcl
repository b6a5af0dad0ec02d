# SPDX-License-Identifier: GPL-2.0-or-later
#
# A HALFILE: gives the simulated machine of this configuration a probe that feels a virtual part. Add it as the last HALFILE
#
#   [HAL]
#   HALFILE = /path/to/probewright_feel.tcl
#   [PROBEWRIGHT]
#   SETUP = practice.toml      the world to feel; relative paths begin at the folder of the .ini
#   PROGRAM = probewright      the engine; default: $PROBEWRIGHT, else probewright in the PATH
#   AXES = XYZ                 a letter for each joint; default: what KINEMATICS or COORDINATES say
#
# docs/linuxcnc.md says more. Only for axes that are simulated.

package require Hal
source [file join $::env(HALLIB_DIR) hal_procs_lib.tcl]

proc probewright_key {name default} {
  if {[info exists ::PROBEWRIGHT($name)]} { return [string trim [lindex $::PROBEWRIGHT($name) end]] }
  return $default
}

proc probewright_env {name default} {
  if {[info exists ::env($name)] && $::env($name) ne ""} { return $::env($name) }
  return $default
}

# Which axis each joint is, as the kinematics count them.
proc probewright_letters {} {
  set words [join $::KINS(KINEMATICS)]
  foreach word $words {
    if {[regexp -nocase {^coordinates=(.+)$} $word whole letters]} { return [string toupper $letters] }
  }
  switch -- [lindex $words 0] {
    xyzac-trt-kins { return XYZAC }
    xyzbc-trt-kins { return XYZBC }
    xyzab_tdr_kins { return XYZAB }
    5axiskins { return XYZBCW }
  }
  return XYZABCUVW
}

# The letters that the configuration uses, of those that have a joint.
proc probewright_used {joints} {
  set wanted $joints
  if {[info exists ::TRAJ(COORDINATES)]} { set wanted [string toupper [join $::TRAJ(COORDINATES)]] }
  set used ""
  foreach letter [split XYZABCUVW ""] {
    if {[string first $letter $joints] >= 0 && [string first $letter $wanted] >= 0} { append used $letter }
  }
  return $used
}

# Connects an output pin with one of ours, by the signal that it has already if it has one.
proc probewright_from {signal from to} {
  if {![pin_exists $from]} { return }
  set state [is_connected $from existing]
  if {$state ne "not_connected"} { set signal $existing }
  net $signal $from $to
}

proc probewright_units {} {
  set units mm
  if {[info exists ::TRAJ(LINEAR_UNITS)]} { set units [string tolower [lindex $::TRAJ(LINEAR_UNITS) 0]] }
  switch -- $units {
    mm - metric { return 1 }
    in - inch - imperial { return 25.4 }
    cm { return 10 }
    m - meter - metre { return 1000 }
  }
  if {[string is double -strict $units] && $units > 0} { return [expr {1.0 / $units}] }
  error "probewright_feel: \[TRAJ\]LINEAR_UNITS = $units is not known"
}

proc probewright_feel {} {
  set setup [probewright_key SETUP ""]
  if {$setup eq ""} { error "probewright_feel: \[PROBEWRIGHT\]SETUP is missing: the setup file with the part to feel" }
  set joints [probewright_key AXES [probewright_letters]]
  set letters [probewright_used $joints]
  set segment /probewright-[pid]
  if {[catch {loadrt probewright_feel segment=$segment axes=$letters} why]} {
    error "probewright_feel: the component cannot be loaded; is probewright_feel.so among the modules of LinuxCNC? $why"
  }
  loadusr [probewright_key PROGRAM [probewright_env PROBEWRIGHT probewright]] feel $setup --segment $segment
  thread_info threads
  addf probewright-feel $threads(motion-controller,threadname)

  setp probewright-feel.mm-per-unit [probewright_units]
  foreach letter [split $letters ""] {
    set axis [string tolower $letter]
    set from joint.[string first $letter $joints].pos-cmd
    # Motors that pull together move no axis of their own.
    if {[lindex [join $::KINS(KINEMATICS)] 0] eq "corexykins"} { set from axis.$axis.pos-cmd }
    probewright_from probewright-$axis $from probewright-feel.axis-$axis
  }
  probewright_from probewright-tool iocontrol.0.tool-number probewright-feel.tool-number
  probewright_from probewright-speed spindle.0.speed-out probewright-feel.spindle-speed
  probewright_from probewright-angle spindle.0.orient-angle probewright-feel.spindle-angle
  probewright_from probewright-reset iocontrol.0.user-request-enable probewright-feel.reset

  if {[is_connected motion.probe-input was] ne "not_connected"} {
    puts "probewright_feel: motion.probe-input no longer follows $was"
    unlinkp motion.probe-input
  }
  net probewright-probe probewright-feel.probe motion.probe-input
  if {[is_connected motion.enable was] eq "not_connected"} {
    net probewright-ok probewright-feel.ok motion.enable
  } else {
    puts "probewright_feel: motion.enable follows $was: put probewright-feel.ok in that chain, or collisions do not stop the machine"
  }
}

probewright_feel
