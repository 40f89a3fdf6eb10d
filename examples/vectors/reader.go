// Runs Möller and Trumbore's test, in doubles, on the core set: go run reader.go ../../vectors results.json
package main

import ("fmt"; "math"; "os"; "strconv"; "strings")

type vec [3]float64

// The conversions keep Go from fusing products with sums.
func (p vec) dot(q vec) float64 { return float64(p[0]*q[0]) + float64(p[1]*q[1]) + float64(p[2]*q[2]) }
func (p vec) minor(q vec, i, j int) float64 { return float64(p[i]*q[j]) - float64(p[j]*q[i]) }
func (p vec) cross(q vec) vec { return vec{p.minor(q, 1, 2), p.minor(q, 2, 0), p.minor(q, 0, 1)} }
func (p vec) minus(q vec) vec { return vec{p[0] - q[0], p[1] - q[1], p[2] - q[2]} }

// n holds origin, direction, t_min, t_max, a, b and c.
func hits(n []float64) bool {
	at := func(i int) vec { return vec{n[i], n[i+1], n[i+2]} }
	d, e, f, s := at(3), at(11).minus(at(8)), at(14).minus(at(8)), at(0).minus(at(8))
	p, q := d.cross(f), s.cross(e)
	det := e.dot(p)
	u, v, t := s.dot(p)/det, d.dot(q)/det, f.dot(q)/det
	return det != 0 && u >= 0 && v >= 0 && u+v <= 1 && t >= n[6] && t <= n[7]
}

func main() {
	csv, _ := os.ReadFile(os.Args[1] + "/core.csv")
	sha, _ := os.ReadFile(os.Args[1] + "/sha256.txt")
	results, sum, failed := []string{}, 0, 0
	for _, line := range strings.Split(strings.TrimSpace(string(csv)), "\n")[1:] {
		row, n := strings.Split(line, ","), make([]float64, 17)
		for i := range n {
			bits, _ := strconv.ParseUint(row[18+i], 16, 64)
			if n[i] = math.Float64frombits(bits); row[3] == "f32" { n[i] = float64(math.Float32frombits(uint32(bits))) }
		}
		answer := "miss"
		if row[1] == "0" { sum = 0 }
		if hits(n) { answer, sum = "hit", sum+1 }
		triangle, _ := strconv.Atoi(row[1])
		if triangles, _ := strconv.Atoi(row[2]); triangle+1 < triangles { continue } // the group goes on
		right, result := row[6], strconv.Quote(answer)
		if row[4] != "" { right, result = row[4], strconv.Itoa(sum) }
		if right != "free" && right != answer && !(right == "exactly-one" && sum == 1 || right == "at-least-one" && sum > 0) { failed++ }
		results = append(results, fmt.Sprintf("%q: %s", row[0], result))
	}
	fmt.Printf("Moller-Trumbore in Go: %d passed, %d failed\n", len(results)-failed, failed)
	text := fmt.Sprintf("{\"vectors\": %q, \"product\": \"Moller-Trumbore in Go\", \"results\": {\n%s}}\n",
		strings.TrimSpace(string(sha)), strings.Join(results, ",\n"))
	if os.WriteFile(os.Args[2], []byte(text), 0o644) != nil { os.Exit(1) }
}
