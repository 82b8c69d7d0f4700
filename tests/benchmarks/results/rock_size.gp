# SPDX-License-Identifier: GPL-3.0-or-later
$area << EOD
0.081151 61.344 0.13899 60.626 0.16163 6.0341 0.16607
0.040246 60.19 0.073238 59.664 0.093955 5.7299 0.17849
0.025358 59.961 0.046535 59.492 0.054378 5.7536 0.075352
0.013857 59.73 0.024869 59.344 0.034027 5.4002 0.12455
EOD
$point << EOD
0.081151 50.738 0.40837 60.187 0.33637 5.857 0.079826
0.040246 55.821 0.13245 61.147 0.14011 11.362 0.17587
0.025358 58.065 0.04628 61.452 0.047693 17.692 0.27881
0.013857 59.961 0.046069 61.769 0.057434 31.405 0.57359
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
plot $area using 1:2:3 with yerrorlines lw 1.6 lc rgb '#9400d3' title "area units, platens", $area using 1:4:5 with yerrorlines lw 1.6 dt 2 lc rgb '#9400d3' title "area units, gauge length", $point using 1:2:3 with yerrorlines lw 1.6 lc rgb '#009e73' title "point units, platens"
set ylabel "tensile strength, MPa"
set key top right
plot $area using 1:6:7 with yerrorlines lw 1.6 lc rgb '#9400d3' title "area units", $point using 1:6:7 with yerrorlines lw 1.6 lc rgb '#009e73' title "point units"
unset multiplot
