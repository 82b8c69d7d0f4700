# SPDX-License-Identifier: GPL-3.0-or-later
$area << EOD
0.081151 61.345 0.13961 60.63 0.16153 6.0385 0.16728
0.040259 60.255 0.079057 59.748 0.09905 5.9411 0.084642
0.025351 59.921 0.025915 59.422 0.0068114 5.9758 0.077976
EOD
$point << EOD
0.081151 50.738 0.40837 60.187 0.33637 5.8567 0.079817
0.040259 55.867 0.16271 61.132 0.1731 11.427 0.21632
0.025351 58.078 0.13313 61.592 0.16383 17.724 0.42105
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
