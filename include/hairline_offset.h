/* hairline_offset.h: where a new ray starts, in C, for `hairline offset --scheme-cmd`.
 *
 * Include it in one file and define hairline_start_of: that is the whole program. Build it as
 *     cc -O2 -Ipath/to/hairline/include -o mine mine.c -lm
 * and run  hairline offset --scheme-cmd mine=./mine
 *
 * hairline starts the program once a thread and writes hit points to it, a line each; docs/guide/offset.md has the
 * lines, for other languages. Lines end up on standard output, so print nothing else there.
 */
#ifndef HAIRLINE_OFFSET_H
#define HAIRLINE_OFFSET_H

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A hit of a kernel. If `is_f64` is 0, every number is a float, and a formula in float has to round to float. */
typedef struct {
    int is_f64;
    double point[3];     /* the rounded hit point */
    double normal[3];    /* of unit length, on the side from which the first ray came */
    double a[3], b[3], c[3]; /* the triangle */
    double u, v;         /* the weights of b and of c; NaN if the kernel does not give them */
    double t;            /* of the hit; NaN if the kernel does not give it */
    double direction[3]; /* of the new ray */
} hairline_hit;

typedef struct {
    double origin[3];
    double t_min; /* the least t that counts */
} hairline_start;

/* Defined by you. The same hit has the same start. */
static hairline_start hairline_start_of(const hairline_hit *hit);

int main(void) {
    char line[4096];
    while (fgets(line, sizeof line, stdin)) {
        hairline_hit hit;
        hairline_start start;
        double numbers[21];
        char *rest = line;
        int i;
        if (strncmp(line, "end", 3) == 0) {
            fputs(line, stdout);
            fflush(stdout);
            continue;
        }
        if (strncmp(line, "hit f", 5) != 0) return 1;
        hit.is_f64 = line[5] == '6';
        rest = line + 8;
        for (i = 0; i < 21; i++) numbers[i] = strtod(rest, &rest);
        for (i = 0; i < 3; i++) {
            hit.point[i] = numbers[i];
            hit.normal[i] = numbers[3 + i];
            hit.a[i] = numbers[6 + i];
            hit.b[i] = numbers[9 + i];
            hit.c[i] = numbers[12 + i];
            hit.direction[i] = numbers[18 + i];
        }
        hit.u = numbers[15];
        hit.v = numbers[16];
        hit.t = numbers[17];
        start = hairline_start_of(&hit);
        printf("%.17g %.17g %.17g %.17g\n", start.origin[0], start.origin[1], start.origin[2], start.t_min);
    }
    return 0;
}

#endif
