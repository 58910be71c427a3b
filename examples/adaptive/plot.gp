# The error against the number of unknowns: gnuplot -c plot.gp FOLDER PICTURE.svg
folder = ARG1
set terminal svg size 840,420 font "DejaVu Sans,12" background "white"
set output ARG2
set datafile separator ","
set logscale xy
set format xy "10^{%T}"
set xlabel "unknowns"
set ylabel "error in the energy norm"
set key bottom left reverse Left samplen 2
set grid
set multiplot layout 1,2
do for [example in "fichera blind_hole"] {
    set title example eq "fichera" ? "Fichera corner" : "Blind hole" noenhanced
    adaptive = sprintf("%s/%s_adaptive.csv", folder, example)
    uniform = sprintf("%s/%s_uniform.csv", folder, example)
    stats adaptive every ::1 using (log($1)):(log($4)) name "A" nooutput
    stats uniform every ::1 using (log($1)):(log($4)) name "U" nooutput
    plot adaptive every ::1 using 1:4 with linespoints pt 7 lw 2 lc rgb "#0060ad" title "adaptive", \
         adaptive every ::1 using 1:5 with lines dt 3 lw 2 lc rgb "#0060ad" title "adaptive, estimated", \
         uniform every ::1 using 1:4 with linespoints pt 5 lw 2 lc rgb "#dd181f" title "uniform", \
         1.25 * exp(A_max_y) * (x / exp(A_min_x))**(-1.0/3) with lines dt 2 lc rgb "black" title "slope -1/3", \
         1.25 * exp(U_max_y) * (x / exp(U_min_x))**(-2.0/9) with lines dt 4 lc rgb "black" title "slope -2/9"
}
unset multiplot
