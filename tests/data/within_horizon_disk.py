#!/usr/bin/env python3
"""Writes within_horizon_disk.csv: where light crosses the equatorial plane outside the horizon that is seen from within.

Null geodesics by Hamilton's equations in ingoing Kerr coordinates (v, r, theta, phi), followed backwards from the tetrads of within_horizon.py in
Mino time by Gragg's extrapolated midpoint rule with 25 digits. Boyer-Lindquist's azimuth and time at a crossing follow from those coordinates:

    phi_BL = phi - int a dr / Delta,    t_BL = v - int (r^2 + a^2) / Delta dr.

A camera within the horizon has no t_BL: its clock is t + 2 ln(r - r_-) as it comes from v - r, t_BL less 2 r_+ W with
W = ln((r - r_-) / |r - r_+|) / (r_+ - r_-), which goes through the horizon.
"""
import random
from mpmath import mp, mpf, sqrt, sin, cos, log, pi

from within_horizon import metric, rain_tetrad

mp.dps = 25


def rate(a, e, l, y):
    v, r, th, phi, p_r, p_th = y
    s, c = sin(th), cos(th)
    b = r * r + a * a
    delta = r * r - 2 * r + a * a
    scale = -1 / (1 + r)  # backwards, in steps that grow with r
    return [scale * x for x in (
        -a * a * s * s * e + b * p_r + a * l,
        -b * e + delta * p_r + a * l,
        p_th,
        -a * e + a * p_r + l / s ** 2,
        2 * r * e * p_r - (r - 1) * p_r ** 2,
        -a * a * s * c * e ** 2 + l * l * c / s ** 3,
    )]


def step(a, e, l, y, h):
    """One step by Gragg's rule with 2, 4, ... 14 parts, extrapolated to none."""
    table = []
    counts = range(2, 16, 2)
    for n in counts:
        d = h / n
        z0 = y
        z1 = [y[i] + d * k for i, k in enumerate(rate(a, e, l, y))]
        for _ in range(n - 1):
            k = rate(a, e, l, z1)
            z0, z1 = z1, [z0[i] + 2 * d * k[i] for i in range(6)]
        k = rate(a, e, l, z1)
        row = [[(z0[i] + z1[i] + d * k[i]) / 2 for i in range(6)]]
        for j in range(len(table)):
            ratio = mpf(n * n) / (counts[len(table) - 1 - j] ** 2)
            last = table[-1][j]
            row.append([row[j][i] + (row[j][i] - last[i]) / (ratio - 1) for i in range(6)])
        table.append(row)
    return table[-1][-1]


def crossings(a, r, th, boost, n):
    """Of the equatorial plane outside the horizon: [(order, r, phi, delay, p_v, L)]."""
    g = metric(a, r, th)
    tetrad = rain_tetrad(a, r, th, boost)
    up = [tetrad[0][i] - sum(n[k] * tetrad[k + 1][i] for k in range(3)) for i in range(4)]
    down = [sum(g[i][j] * up[j] for j in range(4)) for i in range(4)]
    e, l = -down[0], down[3]
    outer, inner = 1 + sqrt(1 - a * a), 1 - sqrt(1 - a * a)
    gap = outer - inner

    def clock(r):  # of the camera
        return r + 2 * log(r - inner)

    def tortoise(r):
        return r + 2 / gap * (outer * log(r - outer) - inner * log(r - inner))

    def turn(r):
        return a / gap * log((r - outer) / (r - inner))

    found = []
    if e * (outer ** 2 + a * a) - a * l <= 0:
        return found, e, l
    y = [mpf(0), mpf(r), mpf(th), mpf(0), down[1], down[2]]
    came_out = False
    h = mpf(1) / 16
    for _ in range(400):
        after = step(a, e, l, y, h)
        if cos(y[2]) * cos(after[2]) < 0:
            low, high = mpf(0), h
            f_low, f_high = cos(y[2]), cos(after[2])
            part = None
            for _ in range(60):
                part = low - f_low * (high - low) / (f_high - f_low)
                at = step(a, e, l, y, part)
                f = cos(at[2])
                if abs(f) < mpf(10) ** -19:
                    break
                if f * f_low > 0:
                    low, f_low, f_high = part, f, f_high / 2
                else:
                    high, f_high, f_low = part, f, f_low / 2
            if at[1] > outer * mpf("1.001"):
                delay = (mpf(0) - clock(mpf(r))) - (at[0] - tortoise(at[1]))
                found.append((len(found), at[1], at[3] - turn(at[1]), delay))
        moves_in = after[1] < y[1]
        y = after
        came_out = came_out or y[1] > outer
        if len(found) == 3 or y[1] > 60 or (came_out and moves_in and y[1] < outer * mpf("1.001")):
            break
    return found, e, l


def kepler_shift(a, r, e, l):
    """Frequency seen over emitted, of matter on a circular geodesic along +phi; 0 where there is no stable one."""
    z1 = 1 + mp.cbrt(1 - a * a) * (mp.cbrt(1 + a) + mp.cbrt(1 - a))
    z2 = sqrt(3 * a * a + z1 * z1)
    stable = 3 + z2 - mp.sign(a) * sqrt((3 - z1) * (3 + z1 + 2 * z2))
    if r < stable:
        return mpf(0)
    omega = 1 / (r ** mpf("1.5") + a)
    g_tt, g_tp = -(1 - 2 / r), -2 * a / r
    g_pp = r * r + a * a + 2 * a * a / r
    u_t = 1 / sqrt(-(g_tt + 2 * omega * g_tp + omega ** 2 * g_pp))
    return 1 / (u_t * (e - omega * l))


def main():
    random.seed(11)
    cameras = [
        (0.0, 1.999, 1.2), (0.0, 1.0, 1.5), (0.5, 1.8, 1.1), (0.5, 0.9, 2.0), (-0.7, 1.6, 2.0), (0.9, 1.43, 1.0),
        (0.9, 1.0, 1.4), (0.9, 0.7, 0.4), (0.998, 1.05, 1.3),
    ]
    print("id,a,r,theta,observer,beta_r,beta_theta,beta_phi,n_r,n_theta,n_phi,order,r_hit,phi_hit,delay,g_kepler")
    number = 0
    for a, r, th in cameras:
        for kind in range(24):
            boost = [mpf(0)] * 3 if kind < 12 else [mpf(x) for x in ("0.25", "-0.375", "0.5")]
            n = [mpf(random.randint(-999, 999)) / 1000 for _ in range(3)]
            n[0] = abs(n[0]) if kind % 6 else n[0]
            length = sqrt(sum(x * x for x in n))
            found, e, l = crossings(mpf(a), mpf(r), mpf(th), boost, [x / length for x in n])
            for order, r_hit, phi, delay in found:
                if r_hit < 55:
                    fields = [number, repr(a), repr(r), repr(th), "rain" if kind < 12 else "rain_boost"]
                    fields += [mp.nstr(x, 6) for x in boost] + [mp.nstr(x, 6) for x in n] + [order]
                    fields += [mp.nstr(x, 18) for x in (r_hit, phi, delay, kepler_shift(mpf(a), r_hit, e, l))]
                    print(",".join(str(x) for x in fields), flush=True)
            number += 1


if __name__ == "__main__":
    main()
