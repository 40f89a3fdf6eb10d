// Runs Möller and Trumbore's test, in doubles, on the core set: mcs Reader.cs && mono Reader.exe ../../vectors results.json
using System;
using System.Collections.Generic;
using System.IO;
using System.Linq;
static class Reader {
    static double Dot(double[] p, double[] q) { return p[0] * q[0] + p[1] * q[1] + p[2] * q[2]; }

    static double[] Cross(double[] p, double[] q) {
        return new[] { p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0] };
    }

    /// n holds origin, direction, t_min, t_max, a, b and c.
    static bool Hits(double[] n) {
        Func<int, double[]> minusA = at => new[] { n[at] - n[8], n[at + 1] - n[9], n[at + 2] - n[10] };
        double[] d = { n[3], n[4], n[5] }, e = minusA(11), f = minusA(14), s = minusA(0);
        double[] p = Cross(d, f), q = Cross(s, e);
        double det = Dot(e, p);
        if (det == 0) return false;
        double u = Dot(s, p) / det, v = Dot(d, q) / det, t = Dot(f, q) / det;
        return u >= 0 && v >= 0 && u + v <= 1 && t >= n[6] && t <= n[7];
    }

    static double Number(string scalar, string bits) {
        return scalar == "f32" ? BitConverter.ToSingle(BitConverter.GetBytes(Convert.ToUInt32(bits, 16)), 0)
            : BitConverter.Int64BitsToDouble(Convert.ToInt64(bits, 16));
    }

    static void Main(string[] arguments) {
        string product = "Moller-Trumbore in C#";
        var results = new List<string>();
        int hits = 0, failed = 0;
        foreach (var row in File.ReadLines(Path.Combine(arguments[0], "core.csv")).Skip(1).Select(line => line.Split(','))) {
            bool hit = Hits(row.Skip(18).Take(17).Select(bits => Number(row[3], bits)).ToArray());
            hits = (row[1] == "0" ? 0 : hits) + (hit ? 1 : 0);
            if (int.Parse(row[1]) + 1 < int.Parse(row[2])) continue; // the group goes on
            string answer = hit ? "hit" : "miss", right = row[4] == "" ? row[6] : row[4];
            bool pass = right == "free" || right == answer || right == "exactly-one" && hits == 1 || right == "at-least-one" && hits > 0;
            if (!pass) failed++;
            results.Add("\"" + row[0] + "\": " + (row[4] == "" ? "\"" + answer + "\"" : hits.ToString()));
        }
        Console.WriteLine(product + ": " + (results.Count - failed) + " passed, " + failed + " failed");
        string sha = File.ReadAllText(Path.Combine(arguments[0], "sha256.txt")).Trim();
        File.WriteAllText(arguments[1], "{\"vectors\": \"" + sha + "\", \"product\": \"" + product + "\", \"results\": {\n"
            + string.Join(",\n", results) + "}}\n");
    }
}
