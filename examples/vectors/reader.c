/* Runs Möller and Trumbore's test on the core set: cc -o reader reader.c && ./reader ../../vectors results.json
   n holds origin, direction, t_min, t_max, a, b and c. */
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#define MOLLER_TRUMBORE(T, NAME) \
    static int NAME(const T n[17]) { \
        const T *o = n, *d = n + 3, *a = n + 8; T p[3], q[3], s[3], e[3], f[3], det = 0, u = 0, v = 0, t = 0; \
        for (int i = 0; i < 3; i++) e[i] = n[11 + i] - a[i], f[i] = n[14 + i] - a[i], s[i] = o[i] - a[i]; \
        for (int i = 0, j = 1, k = 2; i < 3; i++, j = (i + 1) % 3, k = (i + 2) % 3) \
            p[i] = d[j] * f[k] - d[k] * f[j], q[i] = s[j] * e[k] - s[k] * e[j]; \
        for (int i = 0; i < 3; i++) det += e[i] * p[i], u += s[i] * p[i], v += d[i] * q[i], t += f[i] * q[i]; \
        if (det == 0) return 0; \
        u /= det, v /= det, t /= det; \
        return u >= 0 && v >= 0 && u + v <= 1 && t >= n[6] && t <= n[7]; \
    }
MOLLER_TRUMBORE(float, hits_f32)
MOLLER_TRUMBORE(double, hits_f64)

int main(int argc, char **argv) {
    char path[1000], line[4000], sha[100] = "", *field[40];
    const char *folder = argc > 1 ? argv[1] : "vectors", *product = "Moller-Trumbore in C";
    FILE *digest = fopen((snprintf(path, sizeof path, "%s/sha256.txt", folder), path), "r");
    FILE *csv = fopen((snprintf(path, sizeof path, "%s/core.csv", folder), path), "r");
    FILE *out = fopen(argc > 2 ? argv[2] : "results.json", "w");
    if (!digest || !csv || !out || fscanf(digest, "%64s", sha) != 1 || !fgets(line, sizeof line, csv)) return 2;
    fprintf(out, "{\"vectors\": \"%s\", \"product\": \"%s\", \"results\": {", sha, product);
    int hits = 0, passed = 0, failed = 0;
    while (fgets(line, sizeof line, csv)) {
        char *rest = line;
        for (int i = 0; i < 35; i++) field[i] = rest, rest += strcspn(rest, ",\n"), *rest++ = 0;
        float f32[17]; double f64[17];
        for (int i = 0; i < 17; i++) {
            uint64_t wide = strtoull(field[18 + i], 0, 16); uint32_t narrow = (uint32_t)wide;
            memcpy(&f32[i], &narrow, 4), memcpy(&f64[i], &wide, 8);
        }
        int triangle = atoi(field[1]), hit = strcmp(field[3], "f32") ? hits_f64(f64) : hits_f32(f32);
        hits = triangle ? hits + hit : hit;
        if (triangle + 1 < atoi(field[2])) continue; /* the group goes on */
        const char *group = field[4], *answer = hit ? "hit" : "miss", *right = *group ? group : field[6];
        int pass = !strcmp(right, "free") || !strcmp(right, answer) || (!strcmp(right, "exactly-one") && hits == 1)
                || (!strcmp(right, "at-least-one") && hits > 0);
        pass ? passed++ : failed++;
        fprintf(out, "%s\n\"%s\": ", passed + failed > 1 ? "," : "", field[0]);
        *group ? fprintf(out, "%d", hits) : fprintf(out, "\"%s\"", answer);
    }
    fprintf(out, "}}\n"), printf("%s: %d passed, %d failed\n", product, passed, failed);
    return fclose(out) != 0;
}
