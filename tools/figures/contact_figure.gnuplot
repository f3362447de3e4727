# What contact in statics reaches. Needs: out, the folder of the tables' rows.
set terminal svg size 1080,460 font 'sans,12' background rgb 'white'
set output out . '/contact.svg'
set datafile separator '|'
file(name) = out . '/' . name . '.txt'
set grid lc rgb '#dddddd'
set key below
set bmargin 10  # room for the keys
set multiplot layout 1,3

set title 'Hertz: error'
set xlabel 'elements over the contact radius'
set ylabel '[%]'
set logscale xy
set xrange [1.7:9.5]; set yrange [0.05:40]
set xtics (2, 4, 8)
plot file('hertz') using 2:(abs($4)) with linespoints pt 7 lw 2 lc rgb '#1b9e77' title 'sphere, force', \
  file('hertz') using 2:(abs($5)) with linespoints pt 7 dt 2 lw 2 lc rgb '#1b9e77' title 'contact radius', \
  file('hertz') using 2:(abs($7)) with linespoints pt 7 dt 3 lw 2 lc rgb '#1b9e77' title 'peak pressure', \
  file('cylinders') using 2:(abs($4)) with linespoints pt 5 lw 2 lc rgb '#d95f02' title 'cylinders, force', \
  file('cylinders') using 2:(abs($5)) with linespoints pt 5 dt 2 lw 2 lc rgb '#d95f02' title 'contact radius', \
  file('cylinders') using 2:(abs($7)) with linespoints pt 5 dt 3 lw 2 lc rgb '#d95f02' title 'peak pressure'

set title 'Dragged sphere: ripple of the force'
set xrange [1.1:5]; set yrange [0.04:4]
set xtics (1.3, 2, 3, 4)
$wanted << END
2.5|0.5
4|0.2
END
plot file('drag') using 3:6 with linespoints pt 7 lw 2 lc rgb '#1b9e77' title 'regular mesh', \
  file('drag_jittered') using 3:6 with linespoints pt 7 dt 2 lw 2 lc rgb '#1b9e77' title 'jittered', \
  $wanted using 1:2 with points pt 2 ps 1.2 lw 2 lc rgb 'black' title 'wanted'

set title 'Its mean force on 8 cells'
set xlabel 'penalty c'
set ylabel '[N]'
unset logscale y
set xrange [7:1500]; set yrange [5.1:6.9]
set xtics (10, 100, 1000)
names = 'averaged pointwise'
colours = '#1b9e77 #7570b3'
plot for [i = 1:2] file(word(names, i)) using 3:6 with linespoints pt 7 lw 2 lc rgb word(colours, i) title word(names, i)
unset multiplot
