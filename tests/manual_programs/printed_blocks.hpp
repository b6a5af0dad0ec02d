#pragma once

#include <string>
#include <vector>

#include "support/heidenhain_bench.hpp"

/// The parameter values that the manuals print in the example of each cycle, with comments of our own.
namespace probewright::testing_support::printed {

using control::ControlKind;

inline const Words cycle400 = {{263, 10}, {264, 3.5}, {265, 25}, {266, 2}, {272, 2}, {267, 1},
                               {261, -5}, {320, 0},   {260, 20}, {301, 0}, {307, 0}, {305, 0}};
inline const Words cycle401 = {{268, -37}, {269, 12}, {270, 75}, {271, 20}, {261, -5},
                               {260, 20},  {307, 0},  {305, 0},  {402, 0},  {337, 0}};
inline const Words cycle402 = {{268, -37}, {269, 12}, {313, 60}, {261, -5}, {270, 75}, {271, 20}, {314, 60}, {315, -5},
                               {320, 0},   {260, 20}, {301, 0},  {307, 0},  {305, 0},  {402, 0},  {337, 0}};
inline const Words cycle403 = {{263, 0},  {264, 0}, {265, 20}, {266, 30}, {272, 1}, {267, -1}, {261, -5}, {320, 0},
                               {260, 20}, {301, 0}, {312, 0},  {337, 0},  {305, 1}, {303, 1},  {380, 90}};
inline const Words cycle405 = {{321, 50}, {322, 50}, {262, 10}, {325, 0}, {247, 90},
                               {261, -5}, {320, 0},  {260, 20}, {301, 0}, {337, 0}};
inline const Words cycle408 = {{321, 50}, {322, 50}, {311, 25}, {272, 1}, {261, -5}, {320, 0},  {260, 20}, {301, 0},
                               {305, 10}, {405, 0},  {303, 1},  {381, 1}, {382, 85}, {383, 50}, {384, 0},  {333, 1}};
inline const Words cycle409 = {{321, 50}, {322, 50}, {311, 25}, {272, 1},  {261, -5}, {320, 0}, {260, 20}, {305, 10},
                               {405, 0},  {303, 1},  {381, 1},  {382, 85}, {383, 50}, {384, 0}, {333, 1}};
inline const Words cycle410 = {{321, 50}, {322, 50}, {323, 60}, {324, 20}, {261, -5}, {320, 0},
                               {260, 20}, {301, 0},  {305, 10}, {331, 0},  {332, 0},  {303, 1},
                               {381, 1},  {382, 85}, {383, 50}, {384, 0},  {333, 1}};
inline const Words cycle411 = with(cycle410, {{305, 0}});
/// The newer edition; the older one prints the rectangle's parameters.
inline const Words cycle412 = {{321, 50}, {322, 50}, {262, 75}, {325, 0}, {247, 60}, {261, -5}, {320, 0},
                               {260, 20}, {301, 0},  {305, 12}, {331, 0}, {332, 0},  {303, 1},  {381, 1},
                               {382, 85}, {383, 50}, {384, 0},  {333, 1}, {423, 4},  {365, 1}};
inline const Words cycle413 = with(cycle412, {{305, 15}});
inline const Words cycle414 = {{263, 37}, {264, 7},  {326, 50}, {296, 95}, {297, 25}, {327, 45}, {261, -5},
                               {320, 0},  {260, 20}, {301, 0},  {304, 0},  {305, 7},  {331, 0},  {332, 0},
                               {303, 1},  {381, 1},  {382, 85}, {383, 50}, {384, 0},  {333, 1}};
/// The newer edition; the older one prints the parameters of the outside corner.
inline const Words cycle415 = {{263, 37}, {264, 7},  {326, 50}, {327, 45}, {308, 1}, {261, -5}, {320, 0},
                               {260, 20}, {301, 0},  {304, 0},  {305, 7},  {331, 0}, {332, 0},  {303, 1},
                               {381, 1},  {382, 85}, {383, 50}, {384, 0},  {333, 1}};
inline const Words cycle416 = {{273, 50}, {274, 50}, {262, 90}, {291, 34}, {292, 70}, {293, 210},
                               {261, -5}, {260, 20}, {305, 12}, {331, 0},  {332, 0},  {303, 1},
                               {381, 1},  {382, 85}, {383, 50}, {384, 0},  {333, 1}};
inline const Words cycle417 = {{263, 25}, {264, 25}, {294, 25}, {320, 0}, {260, 50}, {305, 0}, {333, 0}, {303, 1}};
inline const Words cycle418 = {{268, 20}, {269, 25}, {270, 150}, {271, 25}, {316, 150}, {317, 85}, {318, 22},
                               {319, 80}, {261, -5}, {260, 10},  {305, 12}, {331, 0},   {332, 0},  {303, 1},
                               {381, 1},  {382, 85}, {383, 50},  {384, 0},  {333, 0}};
inline const Words cycle419 = {{263, 25}, {264, 25}, {261, 25}, {320, 0}, {260, 50},
                               {272, 1},  {267, 1},  {305, 0},  {333, 0}, {303, 1}};
inline const Words cycle420 = {{263, 10}, {264, 10}, {265, 15}, {266, 95}, {272, 1}, {267, -1},
                               {261, -5}, {320, 0},  {260, 10}, {301, 1},  {281, 1}};
inline const Words cycle421 = {{273, 50},  {274, 50}, {262, 75}, {325, 0},     {247, 60},    {261, -5},
                               {320, 0},   {260, 20}, {301, 1},  {275, 75.12}, {276, 74.95}, {279, 0.1},
                               {280, 0.1}, {281, 1},  {309, 0},  {330, 0}};
/// The manual prints a nominal diameter of 75 with these limits; 35 is meant.
inline const Words cycle422 = {{273, 50},   {274, 50}, {262, 35}, {325, 90},    {247, 30},   {261, -5},
                               {320, 0},    {260, 10}, {301, 0},  {277, 35.15}, {278, 34.9}, {279, 0.05},
                               {280, 0.05}, {281, 1},  {309, 0},  {330, 0}};
inline const Words cycle423 = {{273, 50}, {274, 50}, {282, 80}, {283, 60}, {261, -5}, {320, 0},
                               {260, 10}, {301, 1},  {284, 0},  {285, 0},  {286, 0},  {287, 0},
                               {279, 0},  {280, 0},  {281, 1},  {309, 0},  {330, 0}};
inline const Words cycle424 = {{273, 50},  {274, 50},  {282, 75},   {283, 35},   {261, -5}, {320, 0},
                               {260, 20},  {301, 0},   {284, 75.1}, {285, 74.9}, {286, 35}, {287, 34.95},
                               {279, 0.1}, {280, 0.1}, {281, 1},    {309, 0},    {330, 0}};
inline const Words cycle425 = {{328, 75},    {329, -12.5}, {310, 0}, {272, 1}, {261, -5}, {260, 10}, {311, 25},
                               {288, 25.05}, {289, 25},    {281, 1}, {309, 0}, {330, 0},  {320, 0},  {301, 0}};
inline const Words cycle426 = {{263, 50}, {264, 25}, {265, 50}, {266, 85},    {272, 2}, {261, -5}, {320, 0},
                               {260, 20}, {311, 45}, {288, 45}, {289, 44.95}, {281, 1}, {309, 0},  {330, 0}};
inline const Words cycle427 = {{263, 35}, {264, 45}, {261, 5},   {320, 0},    {272, 3}, {267, -1},
                               {260, 20}, {281, 1},  {288, 5.1}, {289, 4.95}, {309, 0}, {330, 0}};
inline const Words cycle430 = {{273, 50},   {274, 50},   {262, 80}, {291, 0},    {292, 90},
                               {293, 180},  {261, -5},   {260, 10}, {288, 80.1}, {289, 79.9},
                               {279, 0.15}, {280, 0.15}, {281, 1},  {309, 0},    {330, 0}};
inline const Words cycle431 = {{263, 20}, {264, 20}, {294, -10}, {265, 50}, {266, 80}, {295, 0},
                               {296, 90}, {297, 35}, {298, 12},  {320, 0},  {260, 5},  {281, 1}};

/// Blocks as they are set in print: decimal commas, comments that touch their value, names of other cycles.
struct Block {
  const char* text;
  control::ControlSet controls = control::onBothTNC;
};
inline const std::vector<Block> blocks = {
    {"67 TCH PROBE 0.0 REF. PLANE Q5 X-\n68 TCH PROBE 0.1 X+5 Y+0 Z-5\n"},
    {"67 TCH PROBE 1.0 POLAR\n68 TCH PROBE 1.1 X ANGLE: +30\n69 TCH PROBE 1.2 X+5 Y+0 Z-5\n"},
    {"67 TCH PROBE 1.0 POLAR\n68 TCH PROBE 1.1 X WINKEL: +30\n69 TCH PROBE 1.2 X+5 Y+0 Z-5\n"},
    {"4 TCH PROBE 3.0 MEASURE\n5 TCH PROBE 3.1 Q1\n6 TCH PROBE 3.2 X ANGLE:  +15\n"
     "7 TCH PROBE 3.3 ABST +10  F100 MB1 REFERENCE SYSTEM: 0\n8 TCH PROBE 3.4 ERRORMODE1\n"},
    {"4 TCH PROBE 3.0 MEASURE\n5 TCH PROBE 3.1 Q1\n6 TCH PROBE 3.2 X ANGLE: +15\n"
     "7 TCH PROBE 3.3 DIST +10 F100 MB1 REFERENCE SYSTEM 0\n8 TCH PROBE 3.4 ERRORMODE1\n"},
    {"4 TCH PROBE 4.0 MEASURE\n5 TCH PROBE 4.1 Q1\n6 TCH PROBE 4.2 IX-0.5 IY-1 IZ-1\n"
     "7 TCH PROBE 4.3 ABST+45 F100 MB50 REFERENCE SYSTEM:0\n"},
    {"5 L X-235 Y+356 R0 FMAX\n6 TCH PROBE 9.0 LENGTH\n7 TCH PROBE 9.1 DATUM +50 REFERENCE SYSTEM 0\n",
     control::onITNC530},
    {"5 TCH PROBE 2.0 RADIUS\n6 TCH PROBE 2.1 HEIGHT: +50 R +25.003 DIRECTION: 0\n", control::onITNC530},
    {"5 TCH PROBE 404 BASIC ROTATION\nQ307=+0 ;ANGLE\n"},
    {"5 TCH PROBE 421 HOLE\nQ273=+50 ;X\nQ274=+50 ;Y\nQ262=75 ;D\nQ325=+0 ;START\nQ247=+60 ;STEP\nQ261=-5 ;Z\n"
     "Q320=0 ;MORE\nQ260=+20 ;HEIGHT\nQ301=1 ;BETWEEN\nQ275=75,12;MOST\nQ276=74,95;LEAST\nQ279=0,1 ;TOL 1\n"
     "Q280=0,1 ;TOL 2\nQ281=1 ;LOG\nQ309=0 ;STOP\nQ330=0 ;TOOL\n"},
    {"5 TCH PROBE 423RECTANGLE\nQ273=+50 ;X\nQ274=+40 ;Y\nQ282=90 ;L1\nQ283=70 ;L2\nQ261=-5 ;Z\nQ320=0 ;MORE\n"
     "Q260=+20 ;HEIGHT\nQ301=0 ;BETWEEN\nQ284=90.15 ;MOST\nQ285=89.95 ;LEAST\nQ286=70.1 ;MOST\nQ287=69.9 ;LEAST\n"
     "Q279=0.15 ;TOL 1\nQ280=0.1 ;TOL 2\nQ281=1 ;LOG\nQ309=0 ;STOP\nQ330=0 ;TOOL\n"},
    {"5 TCH PROBE 441 FAST\nQ 396=3000;FEED\nQ 397=0 ;RAPID\nQ 399=1 ;TRACK\nQ 400=1 ;STOP\n", control::onTNC640},
    {"4 TCH PROBE 444 POINT\nQ263=+0 ;X\nQ264=+0 ;Y\nQ294=+0 ;Z\nQ581=+1 ;NX\nQ582=+0 ;NY\nQ583=+0 ;NZ\nQ320=+0 ;MORE\n"
     "Q260=100 ;HEIGHT\nQS400=\"1-1\";TOLERANCE\nQ309=+0 ;STOP\n",
     control::onTNC640},
    {"5 TCH PROBE 460 SPHERE\nQ407=12.5 ;RADIUS\nQ320=0 ;MORE\nQ301=1 ;BETWEEN\nQ423=4 ;TOUCHES\nQ380=+0 ;ANGLE\n"
     "Q433=0 ;LENGTH\nQ434=-2.5 ;PRESET\nQ455=15 ;POINTS\n",
     control::onTNC640},
    {"5 TCH PROBE 461 LENGTH\nQ434=+5 ;PRESET\n", control::onTNC640},
    {"5 TCH PROBE 462 RING\nQ407=+5 ;RADIUS\nQ320=+0 ;MORE\nQ423=+8 ;TOUCHES\nQ380=+0 ;ANGLE\n", control::onTNC640},
    {"5 TCH PROBE 463 STUD\nQ407=+5 ;RADIUS\nQ320=+0 ;MORE\nQ301=+1 ;BETWEEN\nQ423=+8 ;TOUCHES\nQ380=+0 ;ANGLE\n",
     control::onTNC640},
    {"5 TCH PROBE 1410 EDGE\nQ1100=+0 ;X\nQ1101=+0 ;Y\nQ1102=+0 ;Z\nQ1103=+0 ;X\nQ1104=+0 ;Y\nQ1105=+0 ;Z\nQ372=+1 "
     ";WAY\n"
     "Q320=+0 ;MORE\nQ260=+100 ;HEIGHT\nQ1125=+2 ;BETWEEN\nQ309=+0 ;STOP\nQ1126=+0 ;AXES\nQ1120=+0 ;POSITION\n"
     "Q1121=+0 ;ROTATION\n",
     control::onTNC640},
    {"5 TCH PROBE 1411 CIRCLES\nQ1100=+0 ;X\nQ1101=+0 ;Y\nQ1102=+0 ;Z\nQ1116=0 ;D 1\nQ1103=+0 ;X\nQ1104=+0 "
     ";Y\nQ1105=+0 ;Z\n"
     "Q1117=+0 ;D 2\nQ1115=0 ;KIND\nQ423=4 ;TOUCHES\nQ325=+0 ;START\nQ1119=+360;ARC\nQ320=+0 ;MORE\nQ260=+100 ;HEIGHT\n"
     "Q1125=+2 ;BETWEEN\nQ309=+0 ;STOP\nQ1126=+0 ;AXES\nQ1120=+0 ;POSITION\nQ1121=+0 ;ROTATION\n",
     control::onTNC640},
    {"5 TCH PROBE 1420 PLANE\nQ1100=+0 ;X\nQ1101=+0 ;Y\nQ1102=+0 ;Z\nQ1103=+0 ;X\nQ1104=+0 ;Y\nQ1105=+0 ;Z\nQ1106=+0 "
     ";X\n"
     "Q1107=+0 ;Y\nQ1108=+0 ;Z\nQ372=+1 ;WAY\nQ320=+0 ;MORE\nQ260=+100 ;HEIGHT\nQ1125=+2 ;BETWEEN\nQ309=+0 ;STOP\n"
     "Q1126=+0 ;AXES\nQ1120=+0 ;POSITION\nQ1121=+0 ;ROTATION\n",
     control::onTNC640},
};

}  // namespace probewright::testing_support::printed
