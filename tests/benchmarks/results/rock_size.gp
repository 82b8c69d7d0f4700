# SPDX-License-Identifier: GPL-3.0-or-later
$area << EOD
0.081151 61.344 0.13899 60.626 0.16163 6.0341 0.16607
0.040259 60.248 0.078773 59.74 0.099077 5.933 0.088726
0.025351 59.913 0.025486 59.414 0.0061703 5.9744 0.079518
EOD
$point << EOD
0.081151 50.738 0.40837 60.187 0.33637 5.857 0.079826
0.040259 55.867 0.16271 61.132 0.1731 11.424 0.2151
0.025351 58.078 0.13313 61.592 0.16383 17.716 0.41328
EOD
set terminal svg size 880,400 font "DejaVu Sans,11" background rgb 'white'
set output "rock_size.svg"
set multiplot layout 1,2
set grid lc rgb '#d8d8d8'
set xlabel "grain size over width"
set xrange [0:*]
set xtics 0.02
set key bottom right
set ylabel "Young's modulus, GPa"
set yrange [0:*]
plot $area using 1:2:3 with yerrorlines lw 1.6 title "area units, platens", $area using 1:4:5 with yerrorlines lw 1.6 title "area units, gauge length", $point using 1:2:3 with yerrorlines lw 1.6 title "point units, platens"
set ylabel "tensile strength, MPa"
set key top right
plot $area using 1:6:7 with yerrorlines lw 1.6 title "area units", $point using 1:6:7 with yerrorlines lw 1.6 title "point units"
unset multiplot
