#!/usr/bin/env python3
"""Prints the reference values of fits_reference_test.cpp: least-squares fits solved with 50 digits.

Run it with mpmath installed; it needs nothing else of the project. Newton's method on the gradient of the sum of squared
orthogonal distances, with derivatives by mpmath's own high-precision differences.
"""
from mpmath import mp, mpf, sqrt, matrix, findroot, diff

mp.dps = 50

CIRCLE = [(1, 7), (2, 6), (5, 8), (7, 7), (9, 5), (3, 7)]
SPHERE = [("10.012", "20.003", "35.001"), ("24.998", "20.011", "20.004"), ("9.991", "35.006", "19.997"),
          ("-4.996", "19.994", "20.009"), ("10.004", "5.003", "19.992"), ("20.601", "30.612", "20.003"),
          ("18.667", "28.661", "28.655")]
ARC = [("350.002", "-120.001"), ("349.936", "-116.512"), ("349.760", "-113.026"), ("349.449", "-109.547"),
       ("349.029", "-106.083"), ("348.478", "-102.635")]
PLANE = [("0", "0", "5.001"), ("100", "0", "6.996"), ("0", "80", "4.003"), ("100", "80", "5.998"), ("52", "37", "5.61")]


def numbers(points):
    return [tuple(mpf(c) for c in p) for p in points]


def minimise(cost, start):
    size = len(start)

    def gradient(*x):
        return [diff(cost, x, tuple(1 if i == j else 0 for j in range(size))) for i in range(size)]

    return findroot(gradient, start, tol=mpf(10) ** -38, maxsteps=60)


def show(name, values):
    print(name, ", ".join(mp.nstr(v, 20) for v in values))


points = numbers(CIRCLE)


def circle_cost(x, y, r):
    return sum((sqrt((p[0] - x) ** 2 + (p[1] - y) ** 2) - r) ** 2 for p in points)


solution = minimise(circle_cost, (mpf("4.74"), mpf("2.98"), mpf("4.71")))
show("circle x y r rms", list(solution) + [sqrt(circle_cost(*solution) / len(points))])

# Ten degrees of a circle of radius 100 about (250, -120), the points off by up to 3 micrometres.
points = numbers(ARC)
solution = minimise(circle_cost, (mpf(250), mpf(-120), mpf(100)))
show("arc x y r rms", list(solution) + [sqrt(circle_cost(*solution) / len(points))])

points = numbers(SPHERE)


def sphere_cost(x, y, z, r):
    return sum((sqrt((p[0] - x) ** 2 + (p[1] - y) ** 2 + (p[2] - z) ** 2) - r) ** 2 for p in points)


solution = minimise(sphere_cost, (mpf(10), mpf(20), mpf(20), mpf(15)))
show("sphere x y z r rms", list(solution) + [sqrt(sphere_cost(*solution) / len(points))])


points = numbers(PLANE)


# z = h + a x + b y
def plane_cost(h, a, b):
    return sum((p[2] - h - a * p[0] - b * p[1]) ** 2 for p in points) / (1 + a * a + b * b)


solution = minimise(plane_cost, (mpf(5), mpf("0.02"), mpf("-0.0125")))
show("plane h a b rms", list(solution) + [sqrt(plane_cost(*solution) / len(points))])
