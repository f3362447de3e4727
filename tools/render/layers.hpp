#pragma once

#include <vtkImageData.h>
#include <vtkSmartPointer.h>

class vtkRenderWindow;

/// A picture from several drawings of one scene. Images are RGB of one size unless said otherwise.
namespace articular::tools {

using Image = vtkSmartPointer<vtkImageData>;

/// What the window shows. @throws SystemError when the display can't draw
Image drawn(vtkRenderWindow& window);

/// `unveiled` where the mask is white, else `veiled`: so what is translucent covers everything but
/// the surfaces whose colours have to be read.
Image unveiled_where(vtkImageData& mask, vtkImageData& unveiled, vtkImageData& veiled);

/// Every pixel the mean of n x n.
Image averaged(vtkImageData& large, int n);

/// RGBA from what was drawn on white and on black: with opacity α and colour c a pixel is
/// α c + 1 − α there and α c here. Exact for whatever blends, text among it.
Image with_opacity(vtkImageData& on_white, vtkImageData& on_black);

}  // namespace articular::tools
