// Runs Möller and Trumbore's test, in doubles, on the core set: java Reader.java ../../vectors results.json
import java.nio.file.*;
import java.util.*;
class Reader {
    static double dot(double[] p, double[] q) { return p[0] * q[0] + p[1] * q[1] + p[2] * q[2]; }

    static double[] cross(double[] p, double[] q) {
        return new double[] {p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]};
    }

    /** n holds origin, direction, t_min, t_max, a, b and c. */
    static boolean hits(double[] n) {
        double[] d = Arrays.copyOfRange(n, 3, 6), e = new double[3], f = new double[3], s = new double[3];
        for (int i = 0; i < 3; i++) { e[i] = n[11 + i] - n[8 + i]; f[i] = n[14 + i] - n[8 + i]; s[i] = n[i] - n[8 + i]; }
        double[] p = cross(d, f), q = cross(s, e);
        double det = dot(e, p);
        if (det == 0) return false;
        double u = dot(s, p) / det, v = dot(d, q) / det, t = dot(f, q) / det;
        return u >= 0 && v >= 0 && u + v <= 1 && t >= n[6] && t <= n[7];
    }

    public static void main(String[] arguments) throws Exception {
        Path folder = Path.of(arguments.length > 0 ? arguments[0] : "vectors");
        String product = "Moller-Trumbore in Java";
        var results = new ArrayList<String>();
        int hits = 0, failed = 0;
        var lines = Files.readAllLines(folder.resolve("core.csv"));
        for (String line : lines.subList(1, lines.size())) {
            String[] row = line.split(",");
            double[] n = new double[17];
            for (int i = 0; i < 17; i++) {
                long bits = Long.parseUnsignedLong(row[18 + i], 16);
                n[i] = row[3].equals("f32") ? Float.intBitsToFloat((int) bits) : Double.longBitsToDouble(bits);
            }
            int triangle = Integer.parseInt(row[1]);
            boolean hit = hits(n);
            hits = (triangle == 0 ? 0 : hits) + (hit ? 1 : 0);
            if (triangle + 1 < Integer.parseInt(row[2])) continue; // the group goes on
            String answer = hit ? "hit" : "miss", right = row[4].isEmpty() ? row[6] : row[4];
            boolean pass = right.equals("free") || right.equals(answer)
                || right.equals("exactly-one") && hits == 1 || right.equals("at-least-one") && hits > 0;
            if (!pass) failed++;
            results.add("\"" + row[0] + "\": " + (row[4].isEmpty() ? "\"" + answer + "\"" : hits));
        }
        System.out.println(product + ": " + (results.size() - failed) + " passed, " + failed + " failed");
        String sha = Files.readString(folder.resolve("sha256.txt")).trim();
        Files.writeString(Path.of(arguments.length > 1 ? arguments[1] : "results.json"), "{\"vectors\": \"" + sha
            + "\", \"product\": \"" + product + "\", \"results\": {\n" + String.join(",\n", results) + "}}\n");
    }
}
