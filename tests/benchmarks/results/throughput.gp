# SPDX-License-Identifier: GPL-3.0-or-later
$circles1 << EOD
305 28.758
1005 25.454
5022 29.239
49957 19.777
EOD
$circles2 << EOD
5022 41.412
49957 39.494
EOD
$bare << EOD
305 39.358
1005 37.615
5022 39.04
49957 34.565
EOD
$voronoi << EOD
305 5.0627
1005 4.3717
5022 3.974
49957 3.0911
EOD
$delaunay << EOD
671 11.388
2117 9.469
10266 6.8715
100617 4.3299
EOD
$flow << EOD
589 11.477
49957 15.453
EOD
$flow_polygons << EOD
578 4.7744
49928 3.4938
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
