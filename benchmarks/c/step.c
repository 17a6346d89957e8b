/* The recursion of antinode.riccati.lanes, eight lanes: table of 24 rows with `columns` columns. */
#define LANES 8

static void advance(const double *restrict t, int columns, double *restrict s, int last) {
  for (int i = 0; i < last; i++) {
    const double *q = t + i;
#define T(r) q[(long)(r) * columns]
    double a0 = T(0), a1 = T(1), a2 = T(2), a3 = T(3), b0 = T(4), b1 = T(5), b2 = T(6), b3 = T(7);
    double c0 = T(8), c1 = T(9), c2 = T(10), c3 = T(11), d0 = T(12), d1 = T(13), d2 = T(14), d3 = T(15);
    double n = T(16), inertia = T(17), r1 = T(18), r2 = T(19), r3 = T(20), r4 = T(21);
    for (int l = 0; l < LANES; l++) {
      double c = s[48 + l] * inertia;
      double G0 = a0 + c * (a1 + c * (a2 + c * a3)), G1 = b0 + c * (b1 + c * (b2 + c * b3));
      double G2 = c0 + c * (c1 + c * (c2 + c * c3)), G3 = d0 + c * (d1 + c * (d2 + c * d3));
      double h0 = c * G0, h1 = c * G1, h2 = c * G2, h3 = c * G3;
      double w = G2 + n * G0, v = G3 + n * G1, u = h2 - n * h0, z = h3 - n * h1;
      double p = 1.0 - n * w - h0, o = p - h0, r = n * v + h1, e = 1.0 - 2.0 * h0;
      double a = s[l], B = s[8 + l] * r1, E = s[16 + l] * r2, D = s[24 + l] * r3, F = s[32 + l] * r4;
      double following = p * a + v * B + w * E + G1 * D + G0 * F;
      double trace = G0 * (2.0 * B + D) + a * (2.0 * G1 + v);
      s[l] = following;
      s[8 + l] = o * B - r * a + v * E + G2 * D + G1 * F;
      s[16 + l] = e * E - u * a - (h1 + h1) * B + v * D + w * F;
      s[24 + l] = o * D - z * a - (h2 + h2) * B - (h1 + h1) * E + v * F;
      s[32 + l] = (n * (h2 + h2) + c * h0) * a - z * B - u * E - r * D + p * F;
      s[40 + l] += a * following < 0.0 ? 1.0 : (trace * a < 0.0 ? 2.0 : 0.0);
    }
  }
}

/* Start at a free end and pass the chain, `times` times. */
void repeat(const double *t, int columns, double *s, int last, int times) {
  for (int k = 0; k < times; k++) {
    for (int j = 0; j < 48; j++) s[j] = j < LANES ? 1.0 : 0.0;
    advance(t, columns, s, last);
  }
}

/* A fixed amount of arithmetic, to tell how fast the machine is. */
double calibrate(long turns) {
  double x = 1.0, y = 0.5;
  for (long k = 0; k < turns; k++) { x = x * 0.999999 + y; y = 1.0 - x * 1e-7; }
  return x + y;
}
