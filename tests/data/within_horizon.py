#!/usr/bin/env python3
"""Writes within_horizon.csv: what an observer within the horizon sees, from equations that the program does not use.

Null geodesics by Hamilton's equations in ingoing Kerr coordinates (v, r, theta, phi), which are regular at the outer horizon, with
40 digits. The rain's tetrad is made there by Gram and Schmidt; a ray is followed from the observer backwards, as a function of u = 1/r,
by a Runge-Kutta method of fourth order, and extrapolated from three numbers of steps. Light is dark where its energy at infinity is not
positive, or where du/dlambda has a zero between the observer and infinity.
"""
import random
from mpmath import mp, mpf, sqrt, sin, cos

mp.dps = 30


def metric(a, r, th):
    """Covariant components in (v, r, theta, phi)."""
    sigma = r * r + (a * cos(th)) ** 2
    delta = r * r - 2 * r + a * a
    area = (r * r + a * a) ** 2 - a * a * delta * sin(th) ** 2
    s2 = sin(th) ** 2
    g = [[mpf(0)] * 4 for _ in range(4)]
    g[0][0] = -(1 - 2 * r / sigma)
    g[0][1] = g[1][0] = mpf(1)
    g[0][3] = g[3][0] = -2 * a * r * s2 / sigma
    g[1][3] = g[3][1] = -a * s2
    g[2][2] = sigma
    g[3][3] = area * s2 / sigma
    return g


def product(g, x, y):
    return sum(g[i][j] * x[i] * y[j] for i in range(4) for j in range(4))


def rain_tetrad(a, r, th, boost):
    """Unit vectors u, e_r, e_theta, e_phi of who falls from rest at infinity without angular momentum, moving on at `boost`."""
    g = metric(a, r, th)
    sigma = r * r + (a * cos(th)) ** 2
    # u_v = -1, u_theta = u_phi = 0, and u_r from the inverse metric: Delta u_r^2 - 2 (r^2 + a^2) u_r + a^2 sin^2 + Sigma = 0.
    delta = r * r - 2 * r + a * a
    b = r * r + a * a
    c = a * a * sin(th) ** 2 + sigma
    u_r = c / (b + sqrt(b * b - delta * c))
    up = [
        (a * a * sin(th) ** 2 * -1 + b * u_r) / sigma,
        (-b + delta * u_r) / sigma,
        mpf(0),
        (-a + a * u_r) / sigma,
    ]
    vectors = [up]
    # Gram-Schmidt with d_phi first: e_phi is along it, as for the zero-angular-momentum observer.
    for axis in (3, 2, 1):
        e = [mpf(1) if i == axis else mpf(0) for i in range(4)]
        for f in vectors:
            sign = -1 if f is up else 1
            k = sign * product(g, e, f)
            e = [e[i] - k * f[i] for i in range(4)]
        n = sqrt(product(g, e, e))
        vectors.append([x / n for x in e])
    u, e_phi, e_theta, e_r = vectors
    frame = [u, e_r, e_theta, e_phi]
    beta2 = sum(x * x for x in boost)
    if beta2 == 0:
        return frame
    gamma = 1 / sqrt(1 - beta2)
    boosted = []
    for k in range(4):
        if k == 0:
            w = [gamma] + [gamma * x for x in boost]
        else:
            w = [gamma * boost[k - 1]] + [
                (1 if i == k - 1 else 0) + (gamma - 1) * boost[i] * boost[k - 1] / beta2 for i in range(3)
            ]
        boosted.append([sum(w[j] * frame[j][i] for j in range(4)) for i in range(4)])
    return boosted


def potential(a, l, q, u):
    k = q + (l - a) ** 2
    return 1 + (a * a - q - l * l) * u ** 2 + 2 * k * u ** 3 - a * a * q * u ** 4


def ray(a, r, th, boost, n):
    g = metric(a, r, th)
    tetrad = rain_tetrad(a, r, th, boost)
    up = [tetrad[0][i] - sum(n[k] * tetrad[k + 1][i] for k in range(3)) for i in range(4)]
    down = [sum(g[i][j] * up[j] for j in range(4)) for i in range(4)]
    energy = -down[0]
    if energy <= 0:
        return energy, None
    p_r, p_th, l = down[1] / energy, down[2] / energy, down[3] / energy
    q = p_th ** 2 + cos(th) ** 2 * (l * l / sin(th) ** 2 - a * a)
    u0 = 1 / r
    if any(potential(a, l, q, u0 * mpf(i) / 4000) <= 0 for i in range(4001)):
        return energy, None
    # X = r^2 + a^2 - a L is positive at the horizon for light that came in through it.
    horizon = 1 + sqrt(1 - a * a)
    if horizon ** 2 + a * a - a * l <= 0:
        return energy, None

    def rate(u, y):
        w, t, pt, phi = y  # w = p_r / u^2
        scaled = 1 - 2 * u + a * a * u * u
        du = 1 + a * a * u * u - a * l * u * u - scaled * w * u * u  # du/dlambda, forwards
        dw = -w * w * u * (1 - u) - 2 * w * u * (a * a - a * l) + 2 * w * w * u * scaled
        dpt = -(a * a * sin(t) * cos(t) - l * l * cos(t) / sin(t) ** 3)
        dphi = -a + a * w * u * u + l / sin(t) ** 2
        return [dw / du, pt / du, dpt / du, dphi / du]

    def follow(steps):
        y = [p_r / u0 ** 2, mpf(th), p_th, mpf(0)]
        h = -u0 / steps
        for i in range(steps):
            u = u0 * mpf(steps - i) / steps
            k1 = rate(u, y)
            k2 = rate(u + h / 2, [y[j] + h / 2 * k1[j] for j in range(4)])
            k3 = rate(u + h / 2, [y[j] + h / 2 * k2[j] for j in range(4)])
            k4 = rate(u + h, [y[j] + h * k3[j] for j in range(4)])
            y = [y[j] + h / 6 * (k1[j] + 2 * k2[j] + 2 * k3[j] + k4[j]) for j in range(4)]
        return y

    steps = 500
    coarse, middle = follow(steps // 4), follow(steps // 2)
    while True:
        fine = follow(steps)
        once = [[(16 * b[j] - a_[j]) / 15 for j in range(4)] for a_, b in ((coarse, middle), (middle, fine))]
        end = [(32 * once[1][j] - once[0][j]) / 31 for j in range(4)]
        if max(abs(once[1][j] - end[j]) for j in (1, 3)) < mpf(10) ** -13:
            return energy, (end[1], end[3])
        assert steps < 50000, (a, r, th, n)
        coarse, middle, steps = middle, fine, 2 * steps


def main():
    random.seed(7)
    cameras = [
        (0.0, 1.999, 1.2), (0.0, 1.0, 1.5707963267948966), (0.0, 0.2, 0.7),
        (0.5, 1.8, 1.1), (0.5, 0.9, 1.5), (-0.7, 1.6, 2.0), (0.9, 1.43, 1.0), (0.9, 1.0, 1.5707963267948966),
        (0.9, 0.7, 0.4), (0.998, 1.05, 1.3), (0.998, 1.0, 1.5),
    ]
    print("id,a,r,theta,observer,beta_r,beta_theta,beta_phi,n_r,n_theta,n_phi,status,sky_x,sky_y,sky_z,g")
    number = 0
    for a, r, th in cameras:
        for kind in range(8):
            boost = [mpf(0)] * 3 if kind < 4 else [mpf(x) for x in ("0.25", "-0.375", "0.5")]
            n = [mpf(random.randint(-999, 999)) / 1000 for _ in range(3)]
            if kind not in (3, 7):
                n[0] = abs(n[0])
            length = sqrt(sum(x * x for x in n))
            energy, end = ray(mpf(a), mpf(r), mpf(th), boost, [x / length for x in n])
            sky = ["", "", ""]
            if end:
                t, p = end
                sky = [mp.nstr(x, 18) for x in (sin(t) * cos(p), sin(t) * sin(p), cos(t))]
            fields = [number, repr(a), repr(r), repr(th), "rain" if kind < 4 else "rain_boost"]
            fields += [mp.nstr(x, 6) for x in boost] + [mp.nstr(x, 6) for x in n]
            fields += ["escaped" if end else "captured"] + sky + [mp.nstr(1 / energy, 18)]
            print(",".join(str(x) for x in fields), flush=True)
            number += 1


if __name__ == "__main__":
    main()
