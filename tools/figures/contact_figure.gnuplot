# What contact in statics reaches. Needs: out, the folder of the tables' rows.
set terminal svg size 960,400 font 'sans,11' background rgb 'white'
set output out . '/contact.svg'
set datafile separator '|'
file(name) = out . '/' . name . '.txt'
set grid lc rgb '#dddddd'
set key top right reverse Left samplen 2 spacing 1.1
set multiplot layout 1,3

set title 'error beside Hertz'
set xlabel 'elements over the contact radius'
set ylabel 'size of the error [%]'
set logscale xy
set xrange [1.7:9.5]; set yrange [0.07:1000]
set xtics (2, 4, 8)
set ytics (0.1, 1, 10)
plot file('hertz') using 2:(abs($4)) with linespoints pt 7 ps 0.6 lw 1.5 lc rgb '#0072b2' title 'sphere: force', \
  file('hertz') using 2:(abs($5)) with linespoints pt 7 ps 0.6 dt 2 lw 1.5 lc rgb '#0072b2' title 'contact radius', \
  file('hertz') using 2:(abs($7)) with linespoints pt 7 ps 0.6 dt 3 lw 1.5 lc rgb '#0072b2' title 'peak pressure', \
  file('cylinders') using 2:(abs($4)) with linespoints pt 5 ps 0.6 lw 1.5 lc rgb '#d55e00' title 'crossed cylinders: force', \
  file('cylinders') using 2:(abs($5)) with linespoints pt 5 ps 0.6 dt 2 lw 1.5 lc rgb '#d55e00' title 'contact radius', \
  file('cylinders') using 2:(abs($7)) with linespoints pt 5 ps 0.6 dt 3 lw 1.5 lc rgb '#d55e00' title 'peak pressure'

set title 'dragged sphere: ripple of its force'
set ylabel 'ripple [%]'
set xrange [1.1:5]; set yrange [0.07:10]
set xtics (1.3, 2, 3, 4)
$wanted << END
2.5|0.5
4|0.2
END
plot file('drag') using 3:6 with linespoints pt 7 ps 0.6 lw 1.5 lc rgb '#0072b2' title 'regular mesh', \
  file('drag_jittered') using 3:6 with linespoints pt 7 ps 0.6 dt 2 lw 1.5 lc rgb '#0072b2' title 'moved nodes', \
  $wanted using 1:2 with points pt 2 ps 1 lw 1.5 lc rgb 'black' title 'aim'

set title 'its mean force, 1.3 elements'
set xlabel 'stiffness factor'
set ylabel 'force [N]'
unset logscale y
set xrange [7:1500]; set yrange [5.8:7]
set xtics (10, 100, 1000)
set ytics 0.2
names = 'averaged pointwise'
colours = '#0072b2 #d55e00'
plot for [i = 1:2] file(word(names, i)) using 3:6 with linespoints pt 7 ps 0.6 lw 1.5 lc rgb word(colours, i) title word(names, i)
unset multiplot
