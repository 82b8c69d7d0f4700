# SPDX-License-Identifier: GPL-3.0-or-later
$circles1 << EOD
305 61.813
1005 63.483
5022 62.404
49957 43.265
1000058 37.188
EOD
$circles2 << EOD
5022 75.89
49957 81.195
1000058 68.139
EOD
$bare << EOD
305 72.127
1005 72.37
5022 69.773
49957 52.034
1000058 40.211
EOD
$voronoi << EOD
305 11.221
1005 10.281
5022 7.1124
49957 6.3014
EOD
$delaunay << EOD
671 18.984
2117 17.966
10266 13.027
100617 10.424
EOD
$flow << EOD
589 59.406
49957 29.96
EOD
$flow_polygons << EOD
578 13.256
49928 6.1389
EOD
set terminal svg size 640,420 font "DejaVu Sans,11" background rgb 'white'
set output "throughput.svg"
set logscale xy
set format x "10^{%L}"
set grid lc rgb '#d8d8d8'
set xlabel "particles"
set ylabel "million particle-steps per second"
set key outside right
plot $circles1 with linespoints lw 1.6 title "bonded circles, 1 thread", $circles2 with linespoints lw 1.6 title "bonded circles, 2 threads", $bare with linespoints lw 1.6 title "bare kernel", $voronoi with linespoints lw 1.6 title "voronoi", $delaunay with linespoints lw 1.6 title "delaunay", $flow with linespoints lw 1.6 title "flowing circles", $flow_polygons with linespoints lw 1.6 title "flowing hexagons"
