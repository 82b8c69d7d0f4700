# SPDX-License-Identifier: GPL-3.0-or-later
$circles1 << EOD
305 71.701
1005 73.148
5022 70.215
49957 65.499
1000058 24.421
EOD
$circles2 << EOD
5022 103.22
49957 119.27
1000058 48.773
EOD
$bare << EOD
305 88.138
1005 84.348
5022 81.069
49957 64.489
1000058 51.723
EOD
$voronoi << EOD
305 14.509
1005 13.103
5022 12.111
49957 5.8259
EOD
$delaunay << EOD
671 26.267
2117 23.705
10266 22.81
100617 9.4812
EOD
$flow << EOD
589 68.708
49957 39.301
EOD
$flow_polygons << EOD
578 17.817
49928 5.7385
EOD
set terminal svg size 640,420 font "DejaVu Sans,11" background rgb 'white'
set output "throughput.svg"
set logscale xy
set format x "10^{%L}"
set grid lc rgb '#d8d8d8'
set xlabel "particles"
set ylabel "million particle-steps a second"
set key outside right
plot $circles1 with linespoints lw 1.6 title "bonded circles, 1 thread", $circles2 with linespoints lw 1.6 title "bonded circles, 2 threads", $bare with linespoints lw 1.6 title "bare kernel", $voronoi with linespoints lw 1.6 title "voronoi", $delaunay with linespoints lw 1.6 title "delaunay", $flow with linespoints lw 1.6 title "flowing circles", $flow_polygons with linespoints lw 1.6 title "flowing hexagons"
