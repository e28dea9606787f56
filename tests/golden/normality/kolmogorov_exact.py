# P(D < d) of the two-sided K-S statistic in 60 digits: the Durbin matrix of
# Marsaglia, Tsang and Wang (2003) applied n times to one vector. Debian's
# python3-mpmath 1.2.1.
#   python3 kolmogorov_exact.py >> ../kolmogorov.csv
from mpmath import mp, mpf, factorial, floor

mp.dps = 60
BAND = 60  # 1/60! = 1e-82


def cdf(n, d):
    k = int(floor(n * d)) + 1
    m = 2 * k - 1
    h = k - n * d
    inverse = [1 / factorial(t) for t in range(m + 1)]
    power = [h**t * inverse[t] for t in range(m + 1)]
    corner = (2 * h - 1) ** m * inverse[m] if 2 * h > 1 else mpf(0)
    v = [mpf(0)] * m
    v[k - 1] = mpf(1)
    for step in range(n):
        w = []
        for i in range(m):
            first = 0 if i + 1 < m else 1
            terms = range(first, min(BAND, i + 1) + 1)
            w.append(sum(inverse[t] * v[i + 1 - t] for t in terms)
                     - power[i + 1] * v[0])
        w[m - 1] -= sum(power[m - j] * v[j] for j in range(max(0, m - BAND), m))
        w[m - 1] += corner * v[0]
        v = [x * (step + 1) / n for x in w]
    return v[k - 1]


for n, d in [(397, "0.05"), (397, "0.1"), (595, "0.03"), (595, "0.05"),
             (5000, "0.01"), (5000, "0.015"), (5000, "0.02")]:
    p = cdf(n, mpf(d))
    print("%d,%s,%s,%s" % (n, d, mp.nstr(p, 17), mp.nstr(1 - p, 17)), flush=True)
